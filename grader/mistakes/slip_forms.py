"""The catalogue: texts about lines of another language, and about statements with another form."""

from __future__ import annotations

from grader.base.i18n.message import msg

WORDS = {
    "catch": msg("Python has except instead of catch. Write: {wanted}"),
    "throw": msg("Python has raise instead of throw. Write: {wanted}"),
    "switch": msg("Python has match instead of switch. Write: {wanted}"),
    "other_case": msg(
        "In a match, case _: is the case for all other values, and it is the last one. Write: {wanted}"
    ),
    "other_case_last": msg(
        "In a match, case _: is the case for all other values, and it is the last one. Move this line "
        "and its block below the other cases, and write instead of this line: {wanted}"
    ),
    "modifier": msg(
        "Python has no words such as public, private, static or abstract before def and class. "
        "Write: {wanted}"
    ),
    "access": msg(
        "Python has no {wanted}: line in a class. Delete this line. Each def of the class begins in "
        "the same column, 4 spaces behind that of the word class."
    ),
    "parameter_type": msg(
        "The brackets of a def contain names without types before or behind them. Write: {wanted}"
    ),
    "declaration_alone": msg(
        "Python has no declarations: a variable exists from the line that gives it a value. Write "
        "{wanted} = and its first value, or delete this line if a line below does that."
    ),
    "method_value": msg(
        "To pass a method, write self., its name, and no brackets behind it. Write: {wanted}"
    ),
    "arrow_lambda": msg("Python has lambda for a short function without a name. Write: {wanted}"),
    "block_end": msg(
        "In Python a block ends where the indentation ends, without a word. Delete this line."
    ),
    "include": msg(
        "Python has no such line. Delete it. If the file needs a module that no line imports yet, "
        "write import and the name of the module."
    ),
    "negated": msg(
        "Python has no unless and no until: if not and while not begin such blocks. Write: {wanted}"
    ),
    "block_word": msg(
        "No block of Python begins with {wanted}. A condition begins with if, a loop with for or "
        "while, a function with def, a class with class. Write this line with one of them."
    ),
}
FORMS = {
    "import_written": msg(
        "An import has one of two forms: import and a module, or from, a module, import and names. "
        "Write: {wanted}"
    ),
    "form_of_import": msg(
        "An import has one of two forms: import and a module, or from, a module, import and names. "
        "Names consist of letters, digits and _, and only dots separate the parts of a module's "
        "name. Write this line in one of these forms."
    ),
    "handler_as": msg(
        "as is between the class of an error and the name for the error. Write: {wanted}"
    ),
    "handler_class": msg("The class of the error is directly behind except. Write: {wanted}"),
    "handler_types": msg(
        "Several classes behind except are in brackets, with commas between them. Write the brackets."
    ),
    "for_in": msg("A for has the form for name in values. Write: {wanted}"),
    "for_form": msg(
        "A for has the form for name in values, with a colon at its end. To repeat lines 10 times, "
        "write: for i in range(10):"
    ),
    "else_condition": msg("else has no condition, and elif has one. Write: {wanted}"),
    "condition_missing": msg("Between {wanted} and the colon is a condition. Write it there."),
    "after_else": msg(
        "else: is the last part of an if:, so nothing more of this if: can follow line {line}. Move "
        "this line and its block above line {line}, or change the else: there to an elif with its "
        "condition."
    ),
    "else_missing": msg(
        "A value with if behind it needs an else with another value: value if condition else other. "
        "Add else and that value at the end. If there is no other value, write if, the condition and "
        "a colon on the line above, and the rest of this line below it, indented by 4 spaces more. If "
        "the condition is not needed, delete the if and the condition."
    ),
    "lambda_brackets": msg(
        "The parameters of a lambda have no brackets around them, and a colon is behind them. Write: "
        "{wanted}"
    ),
    "lambda_lines": msg(
        "A lambda contains one expression. Write the lines below it as a method with def, and give the "
        "method's name (self. and the name, without brackets) instead of the lambda and these lines."
    ),
    "colon_key": msg("In a dict, a colon is between a key and its value. Write: {wanted}"),
    "key_alone": msg(
        "Each entry of a dict is a key, a colon and a value, and one of this dict has no colon and "
        "value. Add them. A list, in [ ], contains values without keys."
    ),
    "value_missing": msg("A key of this dict has no value behind its colon. Write the value."),
    "equals_written": msg(
        "In a call, = is between the name of a parameter and its value. Write: {wanted}"
    ),
    "change_inside": msg(
        "A value cannot be changed inside of brackets: that is a statement of its own. Write: {wanted} "
        "Then write on a line of its own: {step} (above this line, if the new value is needed here, "
        "else below it)."
    ),
    "lambda_changes": msg(
        "A lambda contains one expression and no statement, and {step} is a statement. Write a method "
        "with def that contains what the lambda does, each part on a line of its own, and last the "
        "line {step}. Write self. and the method's name, without brackets, instead of the lambda."
    ),
    "return_assigns": msg(
        "return gives back a value and cannot assign one. Write on a line of its own: {step} Write "
        "below it, if the value is to be given back: {wanted}"
    ),
    "equals_of_argument": msg(
        "The = between the name of an argument and its value is missing. Write: {wanted}"
    ),
    "entry_quote": msg(
        "An entry of console_scripts is one text: the quote is before its name. Write: {wanted}"
    ),
    "semicolon_in_call": msg(
        "Arguments and elements are separated by commas, and not by semicolons. Write: {wanted}"
    ),
    "line_twice": msg("This line and line {line} above it are the same. Delete one of them."),
    "def_at_margin": msg(
        "This def is at the left margin, and belongs to the class. Indent this line by 4 spaces."
    ),
    "super_open": msg("super is called: ( and ) are behind it. Write: {wanted}"),
    "main_gone": msg(
        "The def of the function to which these lines belong is missing. Write above this line, without "
        "spaces before it: {wanted}"
    ),
    "def_below": msg(
        "This line belongs to the def in line {line}, and stands above it. Exchange the two lines."
    ),
    "lines_swapped": msg(
        "Line {line} and this one are in the wrong order. Exchange the two lines."
    ),
    "argument_in_braces": msg(
        "This argument is inside of the braces that begin in line {line}. Move it above line {line}."
    ),
    "opener_missing": msg("The first bracket of a value is missing. Write: {wanted}"),
    "data_files_gone": msg(
        "The line that begins this list is missing. Write above this line, indented by 4 spaces less: "
        "data_files=["
    ),
    "marker_line_gone": msg(
        "The second half of this line is missing. Write below it, indented by 4 spaces more: "
        "['resource/' + package_name]),"
    ),
    "call_open": msg("The bracket of the call is missing. Write: {wanted}"),
    "comma_at_end": msg("The comma at the end of this line is missing. Write: {wanted}"),
    "import_names": msg("Between the names of an import are commas. Write: {wanted}"),
    "class_for_def": msg("A method begins with def, and not with class. Write: {wanted}"),
    "def_for_class": msg("A class begins with class, and not with def. Write: {wanted}"),
    "def_square": msg("The parameters of a function are in round brackets. Write: {wanted}"),
    "handler_several": msg(
        "Several classes behind except are in brackets, with commas between them, and as is before "
        "the name of the error. Write: {wanted}"
    ),
    "lambda_colon": msg("A colon is behind lambda, before its value. Write: {wanted}"),
    "docstring_quotes": msg(
        "A text that describes the code has three quotes at its beginning and three at its end. Write: "
        "{wanted}"
    ),
    "except_empty": msg(
        "The block of this except is missing. If nothing is to be done there, write {wanted} below this "
        "line, indented by 4 spaces more."
    ),
    "def_self": msg(
        "In the class, the name alone stands behind def. Only a call has self. before it. Write: "
        "{wanted}"
    ),
    "closed_early": msg(
        "The {step} at the end of this line ends the call too early: line {line} and those below it "
        "belong to it too. Delete that {step}: {wanted}"
    ),
    "closed_early_alone": msg(
        "The {step} in this line ends the call too early: line {line} and those below it belong to it "
        "too. Delete this line."
    ),
    "global_set": msg(
        "global contains only the name, and line {line} gives it its first value already. Write: "
        "{wanted}"
    ),
    "global_value": msg(
        "global and nonlocal contain only the name. Write: {wanted} Write on the next line: {step}"
    ),
    "assign_twice": msg(
        "One statement cannot change a value and assign it to another name. Write: {step} Write on the "
        "next line: {wanted}"
    ),
    "name_two_words": msg(
        "Only one name is before the =, and a name is one word. If both words are the name, write in "
        "all lines that use it: {wanted} If one of them is not part of the name, such as a type, "
        "delete that word."
    ),
    "comma_or_name": msg(
        "Two names are side by side. If they are two values, write a comma between them: {wanted} If "
        "they are one name, write _ instead of the space. If one is a part of the other, write a dot."
    ),
    "name_blank": msg("A name has no space in it. Write: {wanted}"),
    "raise_brackets": msg("The text of an error is in the brackets of its class. Write: {wanted}"),
    "quotes_other": msg(
        "The text is in double quotes, so a double quote inside ends it. Write other quotes around "
        "the text: {wanted}"
    ),
    "ends_open": msg(
        "Behind {wanted} at the end of this line, a value or a name is missing. Write it there, or "
        "delete {wanted}."
    ),
    "comment_wrapped": msg(
        "The comment of line {line} ends with its line, so Python reads this line as code. If it "
        "belongs to the comment, write a # before it: {wanted}"
    ),
    "note_without_sign": msg(
        "Python reads this line as code, but it is a row of words. If it is a note, write a # before "
        "it: {wanted}"
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
    "walrus_place": msg(
        ":= assigns only to a plain name, without a dot or brackets. Write the assignment with = on "
        "the line above, and only the name here."
    ),
    "walrus_in_lambda": msg(
        ":= assigns only to a plain name, without a dot or brackets, and a lambda can hold no line with "
        "=. Write a method with this assignment, with =, and with what else the lambda does, each on a "
        "line of its own. Then write the method without () instead of the lambda."
    ),
    "backslash_alone": msg(
        "Outside of quotes, a backslash means that the statement goes on in the next line, so nothing "
        "may be behind it. Delete the backslash; or, if it is part of a text, write the text in quotes."
    ),
    "case_last": msg(
        "A case with a plain name or _ takes every value, so no case can follow it. If that is meant, "
        "move it and its block below the other cases. To compare with the value of a variable, use if "
        "and elif instead of match and case."
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
    "except_last": msg(
        "An except: without a class stops every error, so it is the last one. Move it and its block "
        "below the other except parts of this try:."
    ),
    "import_star": msg(
        "An import with * works only outside of functions and classes. Move the line to the imports "
        "at the top of the file."
    ),
    "default_missing": msg(
        "Behind the = of a parameter is its value for calls that pass none. Write it, or delete the ="
    ),
    "generator": msg(
        "A value with for inside needs brackets of its own if the call has other values. Write ( "
        "before and ) behind it."
    ),
    "comprehension": msg(
        "Several values before for are in brackets. Write ( before the first and ) behind the last."
    ),
    "future_unknown": msg(
        "This Python has no feature {wanted}. Compare its name with the documentation, or delete it "
        "from the line."
    ),
    "field_quotes": msg(
        "Python cannot read a value in the braces of this f-string. Before Python 3.12, such a value "
        "cannot contain the quotes around the f-string, a comment or the end of the line. Give the "
        "value to a variable on the line above, and write only the variable in the braces."
    ),
    "block_missing": msg(
        "This line ends with a colon, but its block is missing. Write the lines of the block below "
        "it, indented by 4 spaces more than this line; or write pass there if nothing is to be done."
    ),
    "ends_equals": msg(
        "Behind the = at the end of this line, the value is missing. Write the value there."
    ),
    "def_half": msg(
        "The parameters of a def end with ): on the line above its block, and line {line} is a "
        "statement of that block. Write: {wanted}"
    ),
    "def_half_open": msg(
        "The parameters of a def end with ): on the line above its block, and line {line} is a "
        "statement of that block. Write, with the names of the missing parameters in the place of …: "
        "{wanted}"
    ),
    "value_half": msg(
        "Line {line} is a new statement, and this one has no end: behind {step} is no name, and the "
        "bracket is not closed. Write, with the name in the place of …: {wanted}"
    ),
    "round_brackets": msg("A call and a def have round brackets. Write: {wanted}"),
    "type_and_value": msg(
        "The type of a variable is behind a colon, and its value behind =. Write: {wanted}"
    ),
}
