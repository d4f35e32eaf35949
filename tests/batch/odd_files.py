"""What students hand in that holds no package that the grader can open, in the real formats."""

from __future__ import annotations

from tests.batch.archives import package, tarred, zipped

SEVEN_ZIP, RAR = b"7z\xbc\xaf\x27\x1c\x00\x04", b"Rar!\x1a\x07\x01\x00"


def locked() -> bytes:
    """Return a zip that needs a password: bit 0 of its members' flags (APPNOTE 4.4.4)."""
    content = bytearray(zipped({"setup.py": b"x"}))
    for start, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        content[content.index(start) + flags] |= 1
    return bytes(content)


# each with what the instructor reads
ODD_FILES: dict[str, tuple[bytes, str]] = {
    "work.7z": (SEVEN_ZIP + bytes(200), "work.7z is a 7z archive, which the grader cannot open"),
    "work.rar": (RAR + bytes(200), "work.rar is a RAR archive, which the grader cannot open"),
    "cut.zip": (zipped(package())[:300], "cut.zip is damaged or incomplete"),
    "cut.tar.xz": (tarred(package(), "w:xz")[:100], "cut.tar.xz is damaged or incomplete"),
    "locked.zip": (locked(), "locked.zip is locked with a password"),
    "nothing.zip": (zipped({}), "nothing.zip is empty"),
    "zero.zip": (b"", "only a file that is named like an archive but is not one: zero.zip"),
    "report.pdf": (b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n1 0 obj\n", "Files found: report.pdf"),
    "answer.txt": (b"I did it on my laptop.\n", "Files found: answer.txt"),
    "essay.docx": (zipped({"word/document.xml": b"<w:document/>"}), "Files found: essay.docx"),
}
