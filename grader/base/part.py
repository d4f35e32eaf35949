"""The base of every pydantic model: unknown keys are refused, and nothing is changed."""

from pydantic import BaseModel, ConfigDict


class Part(BaseModel):
    """A part of a file of ours.

    A model is built on its first use: building all when they are imported takes as long as
    importing pydantic.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
