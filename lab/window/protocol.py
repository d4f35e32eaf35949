"""What the page may ask, checked before it reaches the bridge."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

Name = Annotated[str, Field(max_length=512)]
View = Literal["turtle", "graph", "log", "plot", "parameters", "guide"]
"""What a page can show; the guide needs the graph."""
MOST_SERIES = 12


class _Asked(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class Watch(_Asked):
    """The views that are shown, and the series (topic and field) of the plots.

    `seeks` is whether the plot begins with a field that moves.
    """

    do: Literal["watch"]
    views: list[View] = Field(max_length=6)
    series: list[tuple[Name, Name]] = Field(default=[], max_length=MOST_SERIES)
    seeks: bool = False


class Drive(_Asked):
    """A velocity command for a turtle; `linear` in m/s, `angular` in rad/s."""

    do: Literal["drive"]
    turtle: Name
    linear: float
    angular: float


class Fields(_Asked):
    """A question for the numeric fields of a topic."""

    do: Literal["fields"]
    id: int
    topic: Name


class ReadParameters(_Asked):
    """A question for the parameters of a node."""

    do: Literal["parameters"]
    id: int
    node: Name


class SetParameter(_Asked):
    """A new value of a parameter, as a person types it."""

    do: Literal["set"]
    id: int
    node: Name
    name: Name
    type: Name
    text: Annotated[str, Field(max_length=20_000)]


class Restart(_Asked):
    """Start the bridge again, with the workspace as it is built now."""

    do: Literal["restart"]


Asked = Watch | Drive | Fields | ReadParameters | SetParameter | Restart
ASKED: TypeAdapter[Asked] = TypeAdapter(Annotated[Asked, Field(discriminator="do")])
