"""The page's texts about the student's work: panes, guide, editor, terminals and check."""

from __future__ import annotations

from grader.base.i18n.message import msg

WORK_TEXTS = {
    # the panes
    "arrange": msg("Panes"),
    "panes": msg("Where the panes are"),
    "panes_help": msg(
        "F6 goes to the next part of the page, Shift+F6 to the one before. A tab can also be dragged "
        "to another part, and the lines between the parts can be moved."
    ),
    "panes_reset": msg("As at the beginning"),
    "close": msg("Close"),
    "divider": msg("Line between two parts"),
    "area_left": msg("Left"),
    "area_top": msg("Middle, top"),
    "area_bottom": msg("Middle, bottom"),
    "area_above": msg("Right, top"),
    "area_below": msg("Right, bottom"),
    "area_hidden": msg("Hidden"),
    # the guide
    "guide": msg("Guide"),
    "step": msg("Step"),
    "step_back": msg("Step before"),
    "step_on": msg("Next step"),
    "step_text": msg("Text of the step"),
    "step_done": msg("Done: {number}. {title}"),
    "done_steps": msg("Steps that are done"),
    "steps_done": msg("{done} of {all} steps are done"),
    "type_it": msg("Write it into the terminal"),
    "type_this": msg("Write into the terminal: {command}"),
    "show_line": msg("Show me the line"),
    "hint": msg("Hint"),
    "next_hint": msg("Next hint"),
    "table": msg("Table"),
    # the editor
    "editor": msg("Editor"),
    "files": msg("Files"),
    "file_search": msg("Search a file"),
    "new_file": msg("New file"),
    "create": msg("Create"),
    "save": msg("Save"),
    "saved": msg("{path} is saved."),
    "not_saved": msg("{path}, not saved"),
    "text_of": msg("Text of {path}"),
    "no_file": msg("No file is open. Files shows those of your workspace."),
    "no_such_file": msg("There is no such file."),
    "no_name": msg("Give the new file a path, like src/my_package/my_package/my_node.py."),
    "close_file": msg("Close {path}"),
    "close_unsaved": msg(
        "{path} is not saved. Save it, or close it again: its text is kept for the next time you "
        "open it."
    ),
    "conflict": msg(
        "Another program has saved {path} while you were changing it here. Nothing is lost: choose "
        "which text the file gets, and the other one is kept."
    ),
    "keep_mine": msg("Save my text"),
    "take_theirs": msg("Take the text of the file"),
    "kept_in": msg("The other text is kept in ~/ros2_ws/{place}"),
    "read_again": msg("Another program has saved {path}: it was read again."),
    # the terminals
    "terminal": msg("Terminal"),
    "terminal_new": msg("New terminal"),
    "terminal_beside": msg("Side by side"),
    "terminal_number": msg("Terminal {number}"),
    "terminal_close": msg("Close terminal {number}"),
    "too_many_terminals": msg("There are twelve terminals. Close one first."),
    # the check
    "check": msg("Check"),
    "check_start": msg("Check my package"),
    "check_stop": msg("Stop"),
    "check_hint": msg("The check runs your instructor's checks on your package. It takes a while."),
    "check_runs": msg("The check runs: {seconds} s"),
    "check_failed": msg("The check could not run. Below is what it says."),
    "check_old": msg("Your files have changed since this check."),
    "check_passed": msg("Every check has passed."),
    "check_printed": msg("Everything that it says"),
    "first_cause": msg("What to look at first"),
    "points": msg("{score} of {most} points"),
    # the words of the editor's own library
    "editor: Find": msg("Find"),
    "editor: Replace": msg("Replace"),
    "editor: next": msg("next"),
    "editor: previous": msg("previous"),
    "editor: all": msg("all"),
    "editor: match case": msg("match case"),
    "editor: regexp": msg("regular expression"),
    "editor: by word": msg("whole words"),
    "editor: replace": msg("replace"),
    "editor: replace all": msg("replace all"),
    "editor: close": msg("close"),
    "editor: Go to line": msg("Go to line"),
    "editor: go": msg("go"),
    "editor: Diagnostics": msg("Mistakes"),
    "editor: No diagnostics": msg("No mistake"),
}
