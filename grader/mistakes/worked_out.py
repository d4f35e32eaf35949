"""Mistakes that are found by working out which one change gives the required lines."""

from __future__ import annotations

from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import FromSource, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.change import Change
from grader.package.source.number_forms import number_forms
from grader.package.source.one_change import changes, logged_lines, wanted_lines

LONGEST = 200  # characters of a piece of code that a text shows
INSTEAD = msg("Write {written} instead of {name}.")
DIVISION = msg(
    "/ gives a float, also of two integers, and a float is written with a decimal point. // gives an "
    "integer."
)


def change_of(suspect: Suspect, *sorts: str) -> Change | None:
    """Return the change of one of these sorts after which the node logs the required lines.

    None if the code does not log the lines that came, or if no change is known.
    """
    seen = list(suspect.lines)
    before = logged_lines(suspect.source) if seen else None
    common = min(len(seen), len(before or ()))
    if before is None or not common or before[:common] != seen[:common]:
        return None
    output = suspect.output
    wanted = wanted_lines(output.line, output.start, output.step)
    found = changes(suspect.source, wanted, *sorts)
    short = [change for change in found if len(change.name) + len(change.written) <= LONGEST]
    return short[0] if short else None


def worked_out(slug: str, *sorts: str, variant: str = "") -> FromSource:
    """Return a function that finds `node.slug` where a change of these sorts corrects the lines."""

    def found(suspect: Suspect) -> RecognisedMistake | None:
        change = change_of(suspect, *sorts)
        if change is None:
            return None
        mistake = suspect.finding(slug, change.at, name=change.name, written=change.written)
        words = {**mistake.words, "form": change.form, "line": str(change.at.lineno)}
        shown = "equals" if change.form == "=" else variant
        return replace(mistake, words=words, variant=shown)

    return found


def _operation(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an operation that changes the number; of integers, / gives a float."""
    found = worked_out("number_changed", "operation")(suspect)
    if found is None:
        return None
    name, written = (str(found.params[key]) for key in ("name", "written"))
    divided = "//" in written and name == written.replace("//", "/")
    return replace(found, variant="division") if divided else found


def _joined(suspect: Suspect) -> RecognisedMistake | None:
    """Look for parts of join() to put together, if no other text of a string is enough."""
    if change_of(suspect, "text") is not None:
        return None
    return worked_out("join_between", "joined")(suspect)


def _method(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a method that changes the text; one that fills up a number is told elsewhere."""
    output = suspect.output
    forms = number_forms(suspect.source, output.start, output.step)
    return None if forms else worked_out("text_changed", "method")(suspect)


_node = Family("node", links.PYTHON_STRINGS)
KINDS = (
    _node(
        "as_code",
        "text",
        msg("A value is written as Python code"),
        msg("{form} writes a value as Python code has it: a text is in quotes."),
        INSTEAD,
        whys={"equals": msg("= in the braces also writes the code that is before it.")},
        behind={"run.wrong_text": worked_out("as_code", "code")},
        fixed_by=(node_worked_out.change("code"),),
        examples=(
            example(
                "number_with_quotes",
                Replace(NODE, "str(self.counter_)", "repr(str(self.counter_))"),
                fails="run.output",
            ),
            example(
                "equals_in_braces",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "f'Hello time: {self.counter_=}'",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_changed",
        "text",
        msg("A method changes the text before it is logged"),
        msg("{form} returns another text than the one that it is called on."),
        INSTEAD,
        behind={"run.wrong_text": _method},
        fixed_by=(node_worked_out.change("method"),),
        examples=(
            example(
                "text_in_capitals",
                Replace(
                    NODE,
                    "('Hello time: ' + str(self.counter_))",
                    "(('Hello time: ' + str(self.counter_)).upper())",
                ),
                fails="run.output",
            ),
            example(
                "number_filled_up_by_a_helper",
                Replace(
                    NODE,
                    "class MyFirst",
                    "def pad(n):\n    return str(n).rjust(3)\n\n\nclass MyFirst",
                ),
                Replace(NODE, "str(self.counter_)", "pad(self.counter_)"),
                fails="run.output",
            ),
            example(
                "each_word_in_capitals_by_a_helper",
                Replace(
                    NODE, "class MyFirst", "def head(t):\n    return t.title()\n\n\nclass MyFirst"
                ),
                Replace(NODE, "'Hello time: '", "head('hello time: ')"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "one_digit",
        "text",
        msg("Only numbers of one digit are written as they are"),
        msg(
            "chr() gives one character. From 10 on, a number has more than one digit: str() writes all "
            "of them."
        ),
        INSTEAD,
        behind={"run.wrong_text": worked_out("one_digit", "digit")},
        fixed_by=(node_worked_out.change("digit"),),
        examples=(
            example(
                "digit_as_in_c",
                Replace(NODE, "str(self.counter_)", "chr(ord('0') + self.counter_)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "number_changed",
        "counter",
        msg("An operation gives another number than the line has to show"),
        msg("{name} does not give the number that the line has to show."),
        INSTEAD,
        whys={"division": DIVISION},
        behind={
            "run.wrong_start": _operation,
            "run.wrong_step": _operation,
            "run.wrong_text": _operation,
        },
        fixed_by=(node_worked_out.change("operation"),),
        examples=(
            example(
                "one_more_in_text",
                Replace(NODE, "str(self.counter_)", "str(self.counter_ + 1)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "join_between",
        "text",
        msg("join() puts its text between the wrong parts"),
        msg("join() puts the text that it is called on between all the parts that it gets."),
        INSTEAD,
        behind={"run.wrong_text": _joined},
        fixed_by=(node_worked_out.change("joined"),),
        examples=(
            example(
                "colon_as_a_word",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "' '.join(['Hello', 'time', ':', str(self.counter_)])",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_repeated",
        "text",
        msg("* repeats a text, and does not join it with another one"),
        msg("{name} is the same text several times over. + joins two texts."),
        msg("Write {written} instead of {name}: str() makes a string of a number."),
        behind={"run.wrong_text": worked_out("text_repeated", "repeated")},
        fixed_by=(node_worked_out.change("repeated"),),
        examples=(
            example(
                "text_times_number",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: ' * self.counter_",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "list_shown",
        "text",
        msg("A list is made into a text, with its brackets"),
        msg(
            "Square brackets make a list. As a text, a list has its brackets, quotes and commas too."
        ),
        INSTEAD,
        behind={"run.wrong_text": worked_out("list_shown", "listed")},
        fixed_by=(node_worked_out.change("listed"),),
        examples=(
            example(
                "text_and_number_in_a_list",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "str(['Hello time: ', self.counter_])",
                ),
                fails="run.output",
            ),
            example(
                "number_in_a_list_behind_percent",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "'Hello time: %s' % [self.counter_]",
                ),
                fails="run.output",
            ),
            example(
                "number_in_a_list",
                Replace(NODE, "str(self.counter_)", "str([self.counter_])"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "other_name_shown",
        "counter",
        msg("The line shows another value than the one that counts"),
        msg("Line {form} changes {written}. What is logged is {name}."),
        INSTEAD,
        behind=dict.fromkeys(
            ("run.constant_counter", "run.wrong_start", "run.wrong_text"),
            worked_out("other_name_shown", "name"),
        ),
        fixed_by=(node_worked_out.change("name"),),
        examples=(
            example(
                "period_shown",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.period = 1.0"),
                Replace(NODE, "str(self.counter_)", "str(self.period)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "other_key",
        "counter",
        msg("A value is set under one key and read under another"),
        msg("A dict keeps a value of its own under each key: {name} and {written} are two keys."),
        INSTEAD,
        behind=dict.fromkeys(
            ("run.constant_counter", "run.wrong_step"), worked_out("other_key", "key")
        ),
        fixed_by=(node_worked_out.change("key"),),
        examples=(
            example(
                "counts_under_other_key",
                Replace(NODE, "self.counter_ = 0", "self.data_ = {'n': 0}"),
                Replace(NODE, "str(self.counter_)", "str(self.data_['n'])"),
                Replace(NODE, "self.counter_ += 1", "self.data_['N'] = self.data_['n'] + 1"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "part_of_number",
        "text",
        msg("Only a part of the number is logged"),
        msg("{form} takes only a part of a text. From 10 on, a number has more than one digit."),
        INSTEAD,
        behind=dict.fromkeys(
            ("run.wrong_step", "run.wrong_text"), worked_out("part_of_number", "character")
        ),
        fixed_by=(node_worked_out.change("character"),),
        examples=(
            example(
                "first_digit_only",
                Replace(NODE, "str(self.counter_)", "str(self.counter_)[0]"),
                fails="run.output",
            ),
        ),
    ),
)
