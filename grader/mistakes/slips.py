"""The catalogue: texts about what stops Python from reading a file, for the node's and setup.py."""

from __future__ import annotations

from grader.base.i18n.message import Message, msg, say
from grader.base.shown import shown
from grader.mistakes.slip_forms import FORMS, WORDS
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
    **dict.fromkeys(("output", "note", "patch", "number_lines", "jupyter"), NO_CODE),
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
    "output": msg(
        "Delete that line and those below it up to line {line}: a program printed them in the "
        "terminal, and they are not code."
    ),
    "note": msg(
        "Delete that line, and the others of this kind: they are text of a document, and not code. "
        "To keep such a line, write a # before it."
    ),
    "patch": msg(
        "These lines show a change (a patch, as git diff prints it). Delete each line that begins "
        "with a -, and delete the + at the start of the other lines."
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
    "dots_inside": msg(
        "Other languages write {found} at the end of a line that goes on. Inside of brackets, a line "
        "of Python goes on without a sign. Write: {wanted}"
    ),
    "dots_outside": msg(
        "Other languages write {found} at the end of a line that goes on. Python has a \\ there, with "
        "nothing behind it. Write: {wanted}"
    ),
    "cast": msg("Python converts a value with a call of its type. Write: {wanted}"),
    "elif": msg("Python has the word elif. Write: {wanted}"),
    "capital": msg("This word of Python is written in small letters. Write: {wanted}"),
    "declaration": msg("A Python variable has no type before its name. Write: {wanted}"),
    "function": msg("A function begins with def in Python. Write: {wanted}"),
    "new": msg("Python has no new: to make an object, call its class. Write: {wanted}"),
    "import": msg("In Python, from is before import. Write: {wanted}"),
    "base": msg("The base class is in round brackets after the name. Write: {wanted}"),
    "member": msg("Python has a dot between an object and its part. Write: {wanted}"),
    "except": msg("Python has try: and except …: for errors, and raise instead of throw."),
    **WORDS,
    "arrow": msg(
        "Python has no =>. Write a method with def, and give its name without brackets; a short "
        "function without a name begins with lambda."
    ),
    "then": msg(
        "Python has no then and no do: a line that begins a block ends with a colon. Write: {wanted}"
    ),
    "do_while": msg(
        "Python has no do … while. Delete line {line}, and write instead of this line: {wanted}"
    ),
    "this": msg("In a method, the object has the name self. Write: {wanted}"),
    "constructor": msg(
        "The constructor of a Python class is the method __init__, and its first parameter is self. "
        "Write: {wanted}"
    ),
    "choice": msg("Python has no ? : for a choice. Write: a if condition else b"),
    "backtick": msg("A text is in quotes, ' or \", not in backticks."),
    "assign": msg("Python assigns with =. Write: {wanted}"),
    "braces": msg(
        "Python has no braces around a block. Delete {{ and }}. Write a colon at the end of the line "
        "above the block, and indent each line of the block by 4 spaces."
    ),
}
SIGNS = {
    "commas": msg("Remove that comma: there is nothing before it to separate."),
    "colon": msg("Write ':' instead of '=' between a key and its value: that is a dict, in {{ }}."),
    "equals": msg(
        "In a call, write name=value: '=' between the two, and no quotes around the name."
    ),
    "quote": msg(
        "A text begins and ends with the same quote, on one line. In this line a quote is missing, or "
        "one is too many. If it has no quotes at all, write one on each side of the text."
    ),
    "apostrophe": msg(
        "The text is in single quotes, so the ' inside it ends the text. Write double quotes around "
        "the text: {wanted}"
    ),
    "field_changes": msg(
        "In the braces of an f-string is only a value: nothing that changes it. Write: {wanted} "
        "Then add, on a line of its own below it and in the same column: {step}"
    ),
    "field_sets": msg(
        "In the braces of an f-string is only a value: nothing that changes it. Write: {wanted}"
    ),
    "field_empty": msg(
        "The braces of an f-string need a value. Write between {{ and }} the name of the variable "
        "that is to be shown."
    ),
    "field_format": msg(
        "format() fills the braces here, so the text is no f-string. Remove the f before the "
        "quotes: {wanted}"
    ),
    "field_backslash": msg(
        "Before Python 3.12, the braces of an f-string cannot contain a backslash. Give the text "
        "with the backslash to a variable on the line above, and write the variable in the braces."
    ),
    "future_late": msg(
        "An import from __future__ is the first statement of a file. Move this line above all other "
        "imports and other code (only comments and the text in three quotes at the start of the file "
        "stay above it): {wanted}"
    ),
    "brace_kind": msg("The braces of an f-string end with }}. Write: {wanted}"),
    "brace": msg("The brace in the f-string has no end. Write: {wanted}"),
    "brace_alone": msg("Remove the }} that closes no brace, or write the {{ before the value."),
    "brace_twice": msg("In an f-string, each value is between one {{ and one }}. Write: {wanted}"),
    "brace_wrong": msg("In an f-string, each value is between {{ and }}. Correct the braces."),
    "quotes_inside": msg(
        "The values in this f-string have the same quotes as the f-string, which only Python 3.12 "
        "and later can read. Write: {wanted}"
    ),
    "global": msg("Delete that line: an attribute (self.…) needs no declaration."),
    "clause_alone": msg(
        "This line needs a line with {wanted}: above it, in the same column. The lines between the "
        "two are indented by 4 spaces."
    ),
    "tab": msg(
        "This line is indented with a tab, and line {line} with spaces. Delete the tab and type "
        "{wanted} spaces. The Tab key types spaces if the editor is set so (in VS Code: 'Indent "
        "Using Spaces')."
    ),
    "tab_other": msg(
        "This line is indented with a tab, and the lines around it with spaces. Delete the tab and "
        "type as many spaces as the other lines of its block have."
    ),
    "try_alone": msg(
        "This try: has neither except: nor finally: below its block. Write one of them above line "
        "{line}, in the same column as try:. For Ctrl+C that is except KeyboardInterrupt: and, on "
        "the next line and indented by 4 spaces more, pass."
    ),
    "try_between": msg(
        "This line is between the block of a try: (line {wanted}) and its except: or finally: (line "
        "{line}). Indent it as far as the lines of the block, or move it below the last line that "
        "belongs to the try:."
    ),
    "clause_column": msg(
        "An except: or finally: begins in the same column as its try:. Indent this line as far as "
        "line {line}, and the lines of its block by 4 spaces more."
    ),
    "clause_misspelt": msg("Below the block of a try: comes except or finally. Write: {wanted}"),
    "bracket_below": msg(
        "The last bracket of this line is not closed. Below line {line}, write a line with {wanted}"
    ),
    "bracket_end": msg(
        "A bracket of this line is not closed. Write in line {line}, if the part in brackets ends "
        "there: {wanted}"
    ),
    "bracket_kind": msg(
        "A bracket of this line is of another kind than the one that it closes. Write: {wanted}"
    ),
    "bracket_argument": msg(
        "A bracket of this line is not closed before the comma at its end. Write: {wanted}"
    ),
    "bracket_open": msg(
        "A bracket of this line is not closed. Write {wanted} where the part in brackets ends."
    ),
    "bracket_opener": msg(
        "The }} in line {line} closes a {{, and keys with their values (key: value) are between braces. "
        "Write: {wanted}"
    ),
    "bracket_before": msg(
        "Line {line} has a closing bracket, but the last open one is in this line and of another "
        "kind. Write {wanted} where the part in brackets ends, or instead of the bracket in line "
        "{line}."
    ),
    "bracket_extra": msg("Remove one {wanted}: the line closes more brackets than are open."),
    "bracket_alone": msg(
        "No bracket is open that this {wanted} closes: remove it, or write the bracket that it "
        "closes."
    ),
    "colon_extra": msg(
        "Remove the colon at the end of that line: only lines that begin a block, such as def, if "
        "or try, end with one."
    ),
    "def_brackets": msg("A function has brackets after its name. Write: {wanted}"),
    "two_statements": msg("Write each statement on a line of its own: {wanted}"),
    "def_missing": msg("A function begins with def. Write: {wanted}"),
    "one_equals": msg("One = assigns a value; two compare. Write: {wanted}"),
    "not_indented": msg(
        "Line {line} ends with a colon, so its block comes next: indent this line, and the other "
        "lines of the block, by 4 spaces more than line {line}."
    ),
    "block_empty": msg(
        "This line ends with a colon, but line {line} is not in its block. Write the lines of the "
        "block below this line, indented by 4 spaces; or write pass there if nothing is to be done."
    ),
    "head_twice": msg(
        "Line {line} begins the same block as this line. One of the two is enough: delete this line."
    ),
    "block_comment": msg(
        "The block below this line has only a comment, and a comment is no statement. Write pass "
        "below this line, indented by 4 spaces, if nothing is to be done."
    ),
    "line_above": msg(
        "Indent this line as far as line {line}: the lines of one block begin in the same column."
    ),
    "line_between": msg(
        "This line is indented less than the lines above it and than line {line}, so it ends their "
        "block. If it belongs to the block, indent it as far as line {line}. If not, move it to the place "
        "where it belongs, or delete it."
    ),
    "behind_colon": msg(
        "This line has its block behind the colon, so the block ends with the line, and line {line} "
        "belongs to no block. Move this to a line of its own below, indented as far as line {line}: "
        "{wanted}"
    ),
    "behind_colon_nothing": msg(
        "This line has its block behind the colon, so the block ends with the line, and line {line} "
        "belongs to no block. Delete the {wanted} behind the colon."
    ),
    "head_commented": msg(
        "This line opens the block of line {line}, but is a comment. Remove the # and indent the "
        "line by 4 spaces less than line {line}: {wanted}"
    ),
    "def_gone": msg(
        "This line belongs to a method, and the def of the method is not there. Write above it, "
        "indented as far as line {line}: {wanted}"
    ),
    "def_gone_unknown": msg(
        "This line uses self, so it belongs to a method, but above it is no def with its name. Write "
        "that line with def, indented as far as line {line}; or, if the line belongs to no method, "
        "indent it as far as line {line}."
    ),
    "too_far": msg(
        "A line is indented further only below a line that ends with a colon, and line {line} above "
        "it does not. Indent it as far as line {line}, with {wanted} spaces, and the lines of its "
        "block with it."
    ),
    "too_far_either": msg(
        "A line is indented further only below a line that ends with a colon, and line {line} above "
        "it does not. Indent both the same: as far as the lines of the block that they belong to."
    ),
    "too_far_alone": msg(
        "A line is indented further only below a line that ends with a colon, and line {line} above "
        "it does not. Indent this line as far as line {line}."
    ),
    "too_far_margin": msg(
        "A line is indented further only below a line that ends with a colon, and line {line} above "
        "it does not. Delete the spaces before it, and as many before each line of its block."
    ),
    "margin": msg(
        "The first line of the code begins at the left margin: delete the {wanted} spaces before it."
    ),
    "margin_all": msg(
        "The first line of the code begins at the left margin: delete the {wanted} spaces before it, "
        "and as many before each line below it."
    ),
    "operator_split": msg("The two signs of an operator are next to each other. Write: {wanted}"),
    "operator_swapped": msg("The = is the second sign of <= and >=. Write: {wanted}"),
    "quote_exact": msg("Add the missing quote. Write: {wanted}"),
    "prefix_apart": msg("No space is between the letter and the quote. Write: {wanted}"),
    "dot_bracket": msg("No dot is between a name and its brackets. Write: {wanted}"),
    "parameter_outside": msg("The parameters of a def are inside its brackets. Write: {wanted}"),
    "equals_missing": msg("Between a name and its value is an =. Write: {wanted}"),
    "bracket_first": msg("The ) closes a bracket that the line does not open. Write: {wanted}"),
    "try_gone": msg(
        "This line and those below it belong to a try:, as line {wanted} shows, and the line with try: is "
        "missing. Write try: above this line, in the same column as line {line}."
    ),
    "head_deeper": msg(
        "This line is indented too far: line {line} below it is in the same column, and belongs to its "
        "block. Delete {wanted} spaces before this line."
    ),
    "arrow_behind_colon": msg(
        "The type that a function returns is before the colon, behind ->. Write: {wanted}"
    ),
    "arrow_half": msg("An arrow, ->, is before the type that a function returns. Write: {wanted}"),
    "bracket_closed_before": msg(
        "All brackets of this line are closed before its last ) already, and what follows there is in "
        "the line twice. Write: {wanted}"
    ),
    "bracket_too_early": msg(
        "A ) closes the brackets too early: the last ) of the line has none to close. Write: {wanted}"
    ),
    "quote_at_end": msg(
        "The text ends with a quote, and the three quotes that end it follow directly: Python takes "
        "the first three of the four. Write a space between them: {wanted}"
    ),
    "clauses_in_line": msg(
        "try: and each except …: begin a line of their own. Write this as lines below each other, and "
        "indent what belongs to each by 4 spaces more: {wanted}"
    ),
    "editor_behind": msg(
        "The end of this line is a command for the editor, not code. Write: {wanted}"
    ),
    "import_comma": msg("An import does not end with a comma. Write: {wanted}"),
    "backslash_end": msg(
        "A backslash continues a line only if nothing is behind it. Delete the spaces and the comment "
        "behind it."
    ),
    "colon_inside": msg("A line that begins a block has a colon before the block. Write: {wanted}"),
    "lambda_statement": msg(
        "A lambda contains one expression and no statement. Write this as lines of a method, and give "
        "the method's name (self. and the name, without brackets) instead of the lambda: {wanted}"
    ),
    "quote_other": msg("A text begins and ends with the same quote. Write: {wanted}"),
    "text_two_lines": msg(
        "A text in simple quotes ends on the line where it begins. Join this line and line {line}: "
        "{wanted}"
    ),
    "character_for": msg("Python does not know a sign of this line. Write: {wanted}"),
    "character": msg(
        "Python does not know a sign of this line, for example an emoji. Delete it: {wanted}"
    ),
    "character_note": msg(
        "Python does not know the sign {wanted}. Delete it; or, if the line is a note and not code, "
        "write a # before the line."
    ),
    "decorator_head": msg(
        "A decorator belongs to the def or the class directly below it, and that line is missing: "
        "line {line} is already of its block. Write the class … or def … line between the two."
    ),
    "decorated_def": msg("The word def is missing in this line. Write: {wanted}"),
    "decorator": msg(
        "A decorator belongs to the def or the class below it, and line {line} is neither. Delete "
        "this line, or move it to the line above its def."
    ),
    "finally_first": msg(
        "finally: is the last part of a try:. Move this line and its block, up to line {wanted}, above "
        "line {line}."
    ),
    "clause_deeper": msg(
        "{wanted} begins in the same column as the line to which it belongs. Indent this line as far "
        "as line {line}."
    ),
    "clause_deeper_block": msg(
        "{wanted} begins in the same column as the line to which it belongs. Indent this line as far "
        "as line {line}, and the lines of its block by 4 spaces more."
    ),
    "lines_not_indented": msg(
        "Line {line} ends with a colon, so its block comes next: indent this line, and those below it "
        "up to line {wanted}, by 4 spaces more than line {line}."
    ),
    "entry_parts": msg("An entry is one text, with the = inside its quotes. Write: {wanted}"),
    "assign_swapped": msg("The name that gets the value is on the left of the =. Write: {wanted}"),
    "assign_left": msg(
        "Only the name that gets the value is on the left of the =: one word, or self. and one word."
    ),
    "name_minus": msg(
        "A name cannot contain -, because Python reads it as a minus. Write _ instead, in all lines "
        "that use this name: {wanted}"
    ),
    "name_parts": msg("A name is one word, without spaces and without -. Write: {wanted}"),
    "word_as_name": msg(
        "{wanted} is a word of Python and cannot be a name. Write another name in all lines that "
        "use it, for example my_{wanted}."
    ),
    "word_misspelt": msg("A word of Python is misspelt. Write: {wanted}"),
    "parameter_dot": msg(
        "The brackets of a def contain plain names. Remove the part with the dot: the method "
        "reaches all attributes through self."
    ),
    "import_dot": msg("Dots separate the parts of a module's name. Write: {wanted}"),
    "import_nothing": msg("The name at the end of this line is missing: write it."),
    "call_brackets": msg("A call has brackets. Write: {wanted}"),
    "handler_comma": msg(
        "except takes one class, or several in brackets; as gives the error a name. Write: {wanted}"
    ),
    "plus_missing": msg("A + joins the parts of a text. Write: {wanted}"),
    "comma_missing": msg("A comma separates two values. Write: {wanted}"),
    "colon_missing": msg("A line that begins a block ends with a colon. Write: {wanted}"),
    "goes_on": msg(
        "Outside of brackets, a statement ends with its line. Write a \\ at the end of this line, "
        "with nothing behind it, so that it goes on in line {line}: {wanted}"
    ),
    "goes_on_joined": msg(
        "Outside of brackets, a statement ends with its line. Write this line and line {line} as one "
        "line: {wanted}"
    ),
    "dot_missing": msg("A dot is between an object and its part. Write: {wanted}"),
    "number_unit": msg("A number has no unit in Python. Write: {wanted}"),
    "number_other_unit": msg(
        "A number has no unit in Python. Delete {wanted}, and write the number of seconds, such as "
        "0.5."
    ),
    "braces_outside": msg(
        "A value in braces belongs inside of the quotes of an f-string. Write: {wanted}"
    ),
    "comma_instead": msg("Inside of brackets, a comma separates two values. Write: {wanted}"),
    "text_unquoted": msg("A text is in quotes. Write: {wanted}"),
    "loop_word": msg(
        "{wanted} works only inside a loop (for, while), and this line is in none. Delete it, or "
        "write pass if its block has no other line. To leave a function, write return."
    ),
    "global_late": msg(
        "Move this line up: it comes before all lines of the function that use the name."
    ),
    "global_parameter": msg("{wanted} is a parameter of the function already. Delete this line."),
    "nonlocal_unbound": msg(
        "No function around this one gives a value to a variable {wanted}. Compare the name, letter "
        "by letter, with the line above that sets the variable."
    ),
    "nonlocal_of_file": msg(
        "nonlocal is for a variable of a function around this one. A variable of the file needs global. "
        "Write: {wanted}"
    ),
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
    "backslash": msg(
        "In a text, a backslash and a letter are a code, and this one is not complete. Write an r "
        "before the quotes ({wanted}…), or / instead of each backslash."
    ),
    "argument_order": msg(
        "In a call, no value without a name can be behind one with name=. Write the name of its "
        "parameter and = before this value too. Or remove name= from the values before it, if all "
        "values are in the order of the parameters."
    ),
    "argument_name": msg(
        "In a call, no value without a name can be behind one with name=. Write the name of its "
        "parameter before this value too: {wanted}"
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
    "dict_braces": msg(
        "Keys with their values (key: value) are between braces. Write {{ and }} instead of the "
        "brackets around them."
    ),
    "text_without_end": msg(
        "A text in three quotes begins in this line and has no end. Write {wanted} where the text "
        "ends."
    ),
    **FORMS,
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
        "output": say("a line of a terminal's output: {found}", found=found),
        "note": say("a line of a document: {found}", found=found),
        "patch": say("a line of a patch: {found}", found=found),
        "number_lines": say("a line number: {found}", found=found),
        "numbers": say("a line number: {found}", found=found),
    }
    return texts[slip.variant]
