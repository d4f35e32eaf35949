"""What the exceptions of Python mean, in texts that are true of every program that raises them."""

from __future__ import annotations

from grader.base.i18n.message import msg

MEANINGS = {
    "TypeError": msg(
        "TypeError: a value has a type with which this operation does not work, or a call does not fit the "
        "parameters of what it calls. An exception that nothing catches ends the program."
    ),
    "ValueError": msg(
        "ValueError: a value has a right type, but what is in it cannot be used here. An exception that "
        "nothing catches ends the program."
    ),
    "AttributeError": msg(
        "AttributeError: the object before a dot has no attribute or method with the name behind the dot, "
        "or it does not let it be set. An exception that nothing catches ends the program."
    ),
    "NameError": msg(
        "NameError: a name is used that has no value at this place of the program. An exception that "
        "nothing catches ends the program."
    ),
    "UnboundLocalError": msg(
        "UnboundLocalError: a function assigns to this name, and uses it before it has a value. An "
        "exception that nothing catches ends the program."
    ),
    "KeyError": msg(
        "KeyError: something is looked up by a key or a name that is not there. An exception that nothing "
        "catches ends the program."
    ),
    "IndexError": msg(
        "IndexError: an item is used that does not exist: there are fewer items than the index says. An "
        "exception that nothing catches ends the program."
    ),
    "ZeroDivisionError": msg(
        "ZeroDivisionError: something is divided by 0. An exception that nothing catches ends the program."
    ),
    "AssertionError": msg(
        "AssertionError: the condition of an assert is not true. An exception that nothing catches ends "
        "the program."
    ),
    "NotImplementedError": msg(
        "NotImplementedError: code was called that is not written, or not available. An exception that "
        "nothing catches ends the program."
    ),
    "StopIteration": msg(
        "StopIteration: next() was called, and no further item was there. An exception that nothing "
        "catches ends the program."
    ),
    "EOFError": msg(
        "EOFError: input() found no line to read. An exception that nothing catches ends the program."
    ),
    "PermissionError": msg(
        "PermissionError: the system does not allow the program what it does there, such as to write to a "
        "file. An exception that nothing catches ends the program."
    ),
    "RuntimeError": msg(
        "RuntimeError: what is called cannot be done in the present state of the program. The text behind "
        "it says why. An exception that nothing catches ends the program."
    ),
}
"""Why a program ended, by the name of the exception."""
INSIDE = msg(
    "The line shown did not raise the error itself: it calls code of {library}, and the error was raised "
    "there. Read the last line of the traceback. Look for its cause in the values that this line passes, "
    "and in what earlier lines have given to the same object."
)
