"""The catalogue: texts about what stops Python from reading a file, for the node's and setup.py."""

from __future__ import annotations

from grader.base.i18n.message import Message, msg, say
from grader.base.shown import shown
from grader.package.source.broken_python import Slip
from grader.package.source.pasted import Pasted
from grader.package.source.python import PythonFault

WEB = msg(
    "A web page or a document shows code with its own quotes, spaces and labels. If they are copied "
    "with the code, Python stops at them."
)
KEYBOARD = msg(
    "All brackets, quotes and operators of Python are on an English keyboard. Those of another input "
    "method or of a document look alike, but are different characters."
)
OTHER_LANGUAGE = msg(
    "Other languages have signs and words that Python does not know, or uses in another way. Python "
    "stops at a line with one of them."
)
TYPED = msg(
    "What was typed for another program is now a line of this file. Python reads each line."
)
NO_CODE = msg("Python reads the whole file, and stops at the first line that is not Python code.")
IN_JSON = msg(
    "A notebook holds the code of its cells as texts. Python reads these texts, and runs none of them."
)
NO_TEXT = msg(
    "A Python file contains plain text: its code, and nothing else. Another name does not make a "
    "file one of another kind."
)
PASTED_WHYS = {
    **dict.fromkeys(("sign", "accents"), KEYBOARD),
    "wide": msg(
        "An input method for Japanese, Chinese or Korean writes wide spaces. Python knows only the "
        "ordinary space."
    ),
    **dict.fromkeys(("command", "heredoc", "editor"), TYPED),
    **dict.fromkeys(
        ("page", "markup", "word", "conflict", "conflict_rest", "numbers", "prose", "around"),
        NO_CODE,
    ),
    **dict.fromkeys(("office", "pdf", "compiled", "archive"), NO_TEXT),
    **dict.fromkeys(("number_lines", "jupyter"), NO_CODE),
    **dict.fromkeys(("notebook", "notebook_below"), IN_JSON),
}
PASTED = {
    "quotes": msg("Type the quotes of that line again: ' or \" on the keyboard."),
    "accents": msg(
        "Type the quotes of that line again, and those of other lines with {found}: ' or \" on the "
        "keyboard, and not the key of the accents."
    ),
    "blank": msg("Delete the spaces of that line and type them again."),
    "wide": msg(
        "Switch the input method to English. Delete the wide spaces at the beginning of that line, and "
        "type ordinary spaces, as many as the other lines of its block have."
    ),
    "sign": msg("Type that sign again, with the keyboard set to English."),
    "tag": msg("Remove {found}: it belongs to the web page, not to the code."),
    "label": msg("Delete the line '{found}': it belongs to the web page, not to the code."),
    "fence": msg(
        "Delete the line '{found}', and the other line of this kind above or below the code, if "
        "there is one. In a chat or a web page they mark where the code begins and ends."
    ),
    "prompt": msg(
        "Remove {found} from the start of the lines: it is the prompt of Python, not code."
    ),
    "command": msg(
        "Delete that line: it is a command and not code. Commands are typed in the terminal."
    ),
    "heredoc": msg("Delete the line '{found}': it ends a command of the shell, and is not code."),
    "editor": msg("Delete the line '{found}': it is a command for the editor, not code."),
    "jupyter": msg(
        "Delete the line '{found}': it is a command of a Jupyter notebook, and Python does not know it."
    ),
    "prose": msg("Delete that line: it is a sentence and not code."),
    "around": msg(
        "Keep only the code, lines {line} to {wanted}. Delete everything above and below it, the "
        "lines '{found}' too: that is the text of a chat or a web page, and not Python."
    ),
    "number_lines": msg(
        "Delete lines 1 to {line}: they are the line numbers of a web page, not code."
    ),
    "numbers": msg("Remove the line numbers from the start of the lines: they are not code."),
}
DOCUMENTS = {
    "conflict_rest": msg(
        "Delete this line: git writes such lines where two versions of a file differ. Check that the "
        "code above it is the version that you want."
    ),
    "page": msg(
        "This file is a web page, not the code that the page shows. Copy only the code into the "
        "file (on GitHub: the button Raw)."
    ),
    "markup": msg("This file contains XML, as package.xml does. Write the Python code into it."),
    "notebook_below": msg(
        "The lines from line {line} on are a Jupyter notebook: the code is in it as texts. Delete the "
        "lines above line {line}, rename the file so that its name ends with .ipynb, and open it in "
        "Jupyter or VS Code. Copy the code of its cells, without lines that begin with ! or %, into a "
        "new file with the name of this one. Write #!/usr/bin/env python3 as its first line, and make "
        "it executable with chmod +x."
    ),
    "notebook": msg(
        "This file is a Jupyter notebook: the code is in it as texts, and Python runs none of them. "
        "Rename the file so that its name ends with .ipynb, and open it in Jupyter or VS Code. Copy "
        "the code of its cells, without lines that begin with ! or %, into a new file with the name "
        "of this one. Write #!/usr/bin/env python3 as its first line, and make it executable with "
        "chmod +x."
    ),
    "office": msg(
        "This file is a document of a word processor. Open it there, copy the code, and save it with "
        "a code editor (such as VS Code) as a new file with the name of this one."
    ),
    "pdf": msg(
        "This file is a PDF document. Write the code into a new file with the name of this one, in a "
        "code editor (such as VS Code), and save it as plain text."
    ),
    "compiled": msg(
        "This file is a compiled program, not the code that a person writes. Hand in the file with "
        "the code."
    ),
    "archive": msg(
        "This file is an archive (such as .zip). Extract it, and put the file with the code in its "
        "place."
    ),
    "word": msg(
        "This file is a document in the format RTF, not a plain text. Open it in the program that "
        "wrote it and save it as plain text: in TextEdit with Format > Make Plain Text. In a code "
        "editor you see only the codes of the format."
    ),
    "conflict": msg(
        "git could not join two versions of these lines. Keep one version, and delete the other "
        "one and the lines with <<<<<<<, ======= and >>>>>>> (to line {line})."
    ),
}
LANGUAGE = {
    "increment": msg("Python has no ++ and no --. Write: {wanted}"),
    "increment_inside": msg(
        "Python has no ++ and no --. Add 1 on a line of its own, with += 1 after the name."
    ),
    "comment": msg("A comment begins with # in Python. Write: {wanted}"),
    "compare": msg("Python compares with == and !=. Write: {wanted}"),
    "operator": msg("Python has the words and, or, not instead of &&, ||, !. Write: {wanted}"),
    "elif": msg("Python has the word elif. Write: {wanted}"),
    "declaration": msg("A Python variable has no type before its name. Write: {wanted}"),
    "function": msg("A function begins with def in Python. Write: {wanted}"),
    "new": msg("Python has no new: to make an object, call its class. Write: {wanted}"),
    "import": msg("In Python, from is before import. Write: {wanted}"),
    "base": msg("The base class is in round brackets after the name. Write: {wanted}"),
    "member": msg("Python has a dot between an object and its part. Write: {wanted}"),
    "except": msg("Python has try: and except …: for errors, and raise instead of throw."),
    "arrow": msg(
        "Python has no =>. Write a method with def, and give its name without brackets; a short "
        "function without a name begins with lambda."
    ),
    "then": msg(
        "Python has no then and no do: a line that begins a block ends with a colon. Write: {wanted}"
    ),
    "this": msg("In a method, the object has the name self. Write: {wanted}"),
    "choice": msg("Python has no ? : for a choice. Write: a if condition else b"),
    "backtick": msg("A text is in quotes, ' or \", not in backticks."),
    "assign": msg("Python assigns with =. Write: {wanted}"),
    "braces": msg(
        "Python has no braces around a block. Delete {{ and }}. Write a colon at the end of the line "
        "above the block, and indent each line of the block by 4 spaces."
    ),
}
SIGNS = {
    "apostrophe": msg(
        "The text is in single quotes, so the ' inside it ends the text. Write double quotes around "
        "the text: {wanted}"
    ),
    "block_empty": msg(
        "This line ends with a colon, but line {line} is not in its block. Write the lines of the "
        "block below this line, indented by 4 spaces; or write pass there if nothing is to be done."
    ),
    "brace_extra": msg("In an f-string, each value is between one {{ and one }}. Write: {wanted}"),
    "brace_kind": msg("The braces of an f-string end with }}. Write: {wanted}"),
    "brace_missing": msg("In an f-string, each value is between {{ and }}. Write: {wanted}"),
    "bracket_end": msg(
        "A bracket of this line is not closed. If the part in brackets ends here, write: {wanted}"
    ),
    "bracket_extra": msg("The line closes more brackets than are open. Write: {wanted}"),
    "bracket_kind": msg(
        "A bracket of this line is of another kind than the one that it closes. Write: {wanted}"
    ),
    "call_brackets": msg("A call has brackets. Write: {wanted}"),
    "colon": msg("In a dict, a colon is between a key and its value. Write: {wanted}"),
    "colon_extra": msg(
        "Remove the colon at the end of that line: only lines that begin a block, such as def, if "
        "or try, end with one."
    ),
    "colon_inside": msg("A line that begins a block has a colon before the block. Write: {wanted}"),
    "colon_key": msg("In a dict, a colon is between a key and its value. Write: {wanted}"),
    "colon_missing": msg("A line that begins a block ends with a colon. Write: {wanted}"),
    "comma_at_end": msg("The comma at the end of this line is missing. Write: {wanted}"),
    "comma_missing": msg("A comma separates two values. Write: {wanted}"),
    "def_brackets": msg("A function has brackets after its name. Write: {wanted}"),
    "def_missing": msg("A function begins with def. Write: {wanted}"),
    "dot_missing": msg("A dot is between an object and its part. Write: {wanted}"),
    "equals_missing": msg("Between a name and its value is an =. Write: {wanted}"),
    "handler_as": msg(
        "as is between the class of an error and the name for the error. Write: {wanted}"
    ),
    "head_deeper": msg(
        "This line is indented too far: line {line} below it is in the same column, and belongs to its "
        "block. Indent this line by 4 spaces less."
    ),
    "import_names": msg("Between the names of an import are commas. Write: {wanted}"),
    "line_above": msg(
        "Indent this line as far as line {line}: the lines of one block begin in the same column."
    ),
    "not_indented": msg(
        "Line {line} ends with a colon, so its block comes next: indent this line, and the other "
        "lines of the block, by 4 spaces more than line {line}."
    ),
    "one_equals": msg("One = assigns a value; two compare. Write: {wanted}"),
    "opener_missing": msg("The first bracket of a value is missing. Write: {wanted}"),
    "operator_split": msg("The two signs of an operator are next to each other. Write: {wanted}"),
    "operator_swapped": msg("The = is the second sign of <= and >=. Write: {wanted}"),
    "plus_missing": msg("A + joins the parts of a text. Write: {wanted}"),
    "prefix_apart": msg("No space is between the letter and the quote. Write: {wanted}"),
    "quote_exact": msg("Add the missing quote. Write: {wanted}"),
    "quote_other": msg("A text begins and ends with the same quote. Write: {wanted}"),
    "line_extra": msg("Python can read the file without this line. Delete it."),
    "text_unquoted": msg("A text is in quotes. Write: {wanted}"),
    "equals": msg(
        "In a call, write name=value: '=' between the two, and no quotes around the name."
    ),
    "sign_extra": msg("This line has one sign too many. Write: {wanted}"),
    "sign_other": msg("Python expects another sign in this line. Write: {wanted}"),
    "tab": msg(
        "This line is indented with a tab, and the lines around it with spaces. Delete the tab and "
        "type as many spaces as the other lines of its block have."
    ),
    "two_statements": msg("Write each statement on a line of its own: {wanted}"),
    "word_joined": msg("A space is missing behind a word of Python. Write: {wanted}"),
    "word_misspelt": msg("A word of Python is misspelt. Write: {wanted}"),
    "loop_word": msg(
        "{wanted} works only inside a loop (for, while), and this line is in none. Delete it, or "
        "write pass if its block has no other line. To leave a function, write return."
    ),
    "global_late": msg(
        "Move this line up: it comes before all lines of the function that use the name."
    ),
    "global_parameter": msg("{wanted} is a parameter of the function already. Delete this line."),
    "nonlocal": msg(
        "nonlocal is for a function inside a function. Write self. before the name of a variable "
        "of the node, and global for a variable of the file."
    ),
    "outside_function": msg(
        "{wanted} works only inside a function, and this line is in none. Indent it as far as the "
        "lines of the function to which it belongs, or delete it if it belongs to none."
    ),
    "await_outside": msg(
        "await and async work only inside an async def, and a node needs neither. Delete that word, "
        "and async before the def of each function of yours."
    ),
    "argument_order": msg(
        "In a call, no value without a name can be behind one with name=. Write the name of its "
        "parameter and = before this value too. Or remove name= from the values before it, if all "
        "values are in the order of the parameters."
    ),
    "argument_twice": msg("The call has {wanted}= twice. Delete one of the two."),
    "parameter_twice": msg("The def has the name {wanted} twice. Rename or delete one of the two."),
    "parameter_order": msg(
        "In a def, names without = come first (self before all others), and those with = after "
        "them."
    ),
    "number_letters": msg(
        "A number consists of digits and at most one point, without a unit. A name does not begin "
        "with a digit."
    ),
    "number_zeros": msg("Remove the zeros at the start of the number."),
    "backslash": msg(
        "In a text, a backslash and a letter are a code, and this one is not complete. Write an r "
        "before the quotes of the text, or / instead of each backslash."
    ),
    "try_alone": msg(
        "The try: above this line has neither except: nor finally: below its block. Write one of them "
        "above this line, in the same column as try:. For Ctrl+C that is except KeyboardInterrupt: and, "
        "on the next line and indented by 4 spaces more, pass."
    ),
    "text_without_end": msg(
        "For Python, a text in three quotes begins in this line and has no end. Three quotes are missing "
        "at the end of this text, or of one above."
    ),
    "quote": msg(
        "A text begins and ends with the same quote, on one line. In this line a quote is missing, or "
        "one is too many. If it has no quotes at all, write one on each side of the text."
    ),
    "field_empty": msg(
        "The braces of an f-string need a value. Write between {{ and }} the name of the variable "
        "that is to be shown."
    ),
    "brace_wrong": msg("In an f-string, each value is between {{ and }}. Correct the braces."),
    "bracket_alone": msg(
        "No bracket is open that this {wanted} closes: remove it, or write the bracket that it "
        "closes."
    ),
    "bracket_open": msg(
        "A bracket of this line is not closed. Close it where the part in brackets ends."
    ),
    "block_missing": msg(
        "This line ends with a colon, but its block is missing. Write the lines of the block below "
        "it, indented by 4 spaces more than this line; or write pass there if nothing is to be done."
    ),
    "call_of_word": msg(
        "{wanted} is a function, and its values are in brackets. Write ( behind {wanted} and ) behind "
        "the last value."
    ),
    "call_assigns": msg(
        "In a call, = is only between the name of a parameter and its value, and a name is one word "
        "without dots, quotes and signs. To compare, write ==. To change a value, write that on a line "
        "of its own above."
    ),
    "key_alone": msg(
        "Each entry of a dict is a key, a colon and a value, and one of this dict has no colon and "
        "value. Add them. A list, in [ ], contains values without keys."
    ),
    "value_missing": msg("A key of this dict has no value behind its colon. Write the value."),
    "backslash_alone": msg(
        "Outside of quotes, a backslash means that the statement goes on in the next line, so nothing "
        "may be behind it. Delete the backslash; or, if it is part of a text, write the text in quotes."
    ),
    "except_last": msg(
        "An except: without a class stops every error, so it is the last one. Move it and its block "
        "below the other except parts of this try:."
    ),
    "import_star": msg(
        "An import with * works only outside of functions and classes. Move the line to the imports "
        "at the top of the file."
    ),
    "generator": msg(
        "A value with for inside needs brackets of its own if the call has other values. Write ( "
        "before and ) behind it."
    ),
    "handler_types": msg(
        "Several classes behind except are in brackets, with commas between them. Write the brackets."
    ),
    "stops_at": msg(
        "Python can read what is before {part}, but {part} cannot follow it. The mistake is at this "
        "place or before it in the same statement, which may begin in a line above. Compare the "
        "statement with one of the same kind that works."
    ),
    "told_at": msg(
        "Python stops at {part}. What it expects there, or does not accept, is in its message behind "
        "SyntaxError. Change that part of the statement, or compare the statement with one of the same "
        "kind that works."
    ),
}
KINDS = {
    "pasted": "source.pasted",
    "document": "source.pasted",
    "language": "source.other_language",
    "shebang": "source.wrong_shebang",
}
"""The mistakes of the node's file by the cause of a slip; the others are syntax errors."""


NO_PYTHON = {
    "notebook": say("the file is a Jupyter notebook"),
    "notebook_below": say("the file is a Jupyter notebook"),
    "office": say("the file is a document of a word processor"),
    "pdf": say("the file is a PDF document"),
    "compiled": say("the file is a compiled program"),
    "archive": say("the file is an archive"),
}
"""What a file is, if none of its lines is to be quoted."""


def words_of(slip: Slip | Pasted) -> dict[str, str]:
    """Return the values of the placeholders in the texts above."""
    wanted = slip.wanted if isinstance(slip, Slip) else ""
    line = str(slip.other) if isinstance(slip, Slip) else ""
    step = shown(slip.step) if isinstance(slip, Slip) else ""
    return {"found": shown(slip.found), "wanted": shown(wanted), "line": line, "step": step}


def unexplained(fault: PythonFault) -> str:
    """Return the variant of a fault for which no slip is known: what Python says of it, and where."""
    if fault.kind != "syntax" or not fault.part:
        return fault.kind
    return "stops_at" if "invalid syntax" in fault.text else "told_at"


def description(slip: Slip | Pasted) -> Message:
    """Return what was found at the place of a slip."""
    found = shown(slip.found)
    if isinstance(slip, Slip) and slip.variant in NO_PYTHON:
        return NO_PYTHON[slip.variant]
    if isinstance(slip, Slip) and slip.cause in ("signs", "document", "shebang"):
        return say("in: {code}", code=found)
    if isinstance(slip, Slip) and slip.cause == "language":
        return say("this is not Python: {found}", found=found)
    texts = {
        "quotes": say("typographic quotes: {found}", found=found),
        "accents": say("accents instead of quotes: {found}", found=found),
        "wide": say("a wide space: {found}", found=found),
        "blank": say("a space that is not an ordinary one: {found}", found=found),
        "sign": say("a sign that Python does not know: {found}", found=found),
        "tag": say("a part of a web page: {found}", found=found),
        "label": say("a line of a web page: {found}", found=found),
        **dict.fromkeys(("fence", "around"), say("a line of a web page: {found}", found=found)),
        "prompt": say("the prompt of Python: {found}", found=found),
        "command": say("a command for the terminal: {found}", found=found),
        "heredoc": say("the end of a command of the shell: {found}", found=found),
        "editor": say("a command for the editor: {found}", found=found),
        "jupyter": say("a command of a Jupyter notebook: {found}", found=found),
        "prose": say("a sentence: {found}", found=found),
        "number_lines": say("a line number: {found}", found=found),
        "numbers": say("a line number: {found}", found=found),
    }
    return texts[slip.variant]
