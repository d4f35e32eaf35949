"""Texts about a Python file in another encoding than UTF-8, by the kind of encoding."""

from grader.base.i18n.message import msg

NOT_UTF8 = msg(
    "Python reads source files as UTF-8; a single invalid byte makes the file unreadable."
)
DECLARED = msg("Python reads a source file in the encoding that a comment in line 1 or 2 declares.")
ENCODINGS = {
    "other_encoding": msg(
        "In VS Code, click the encoding (UTF-8) at the bottom right. Choose 'Reopen with "
        "Encoding' first, and the encoding in which the text is readable, such as 'Western "
        "(Windows 1252)' or 'Korean (EUC-KR)'. Then click it again, and choose 'Save with "
        "Encoding' and 'UTF-8'. If you save before you reopen, these letters are lost."
    ),
    "declared": msg(
        "The file is UTF-8, but line {line} declares the encoding {found}. Delete that line: "
        "Python expects UTF-8 without it."
    ),
    "korean": msg(
        "In VS Code, click the encoding (UTF-8) at the bottom right. Choose 'Reopen with "
        "Encoding' first, and 'Korean (EUC-KR)': the text is readable again. Then click it "
        "again, and choose 'Save with Encoding' and 'UTF-8'. If you save before you "
        "reopen, these letters are lost. Korean text itself is fine in a UTF-8 file."
    ),
    "saved": msg(
        "Save the file as UTF-8. In VS Code: click the encoding at the bottom right, then "
        "choose 'Save with Encoding' and 'UTF-8'."
    ),
}
