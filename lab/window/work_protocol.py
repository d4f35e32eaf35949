"""What the page may ask of the workspace, checked before anything is done."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

Path = Annotated[str, Field(min_length=1, max_length=1024)]
Text = Annotated[str, Field(max_length=1_000_000)]
Version = Annotated[str, Field(max_length=64)]


class _Asked(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)

    id: int = 0
    """Of a question; 0: no answer is wanted."""


class Read(_Asked):
    """A question for a file."""

    do: Literal["read"]
    path: Path


class Save(_Asked):
    """A file to save; `keeps`: what has this version now is kept in the backups."""

    do: Literal["save"]
    path: Path
    text: Text
    version: Version
    keeps: bool = False


class Draft(_Asked):
    """A text that is not saved yet; None: there is none any more."""

    do: Literal["draft"]
    path: Path
    text: Text | None
    version: Version


class Keep(_Asked):
    """A text to keep in the backups, because the student takes the file's."""

    do: Literal["keep"]
    path: Path
    text: Text


class Layout(_Asked):
    """Where the panes are, as the page has it."""

    do: Literal["layout"]
    layout: Annotated[str, Field(max_length=20_000)]


class Close(_Asked):
    """A terminal to close."""

    do: Literal["close"]
    number: int


class Simple(_Asked):
    """What needs no more words."""

    do: Literal["hint", "check", "stop", "open", "files"]


Asked = Read | Save | Draft | Keep | Layout | Close | Simple
ASKED: TypeAdapter[Asked] = TypeAdapter(Annotated[Asked, Field(discriminator="do")])
