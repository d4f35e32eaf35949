"""What a submission cannot foresee: how many lines are watched and for how long, and drawn values.

All is computed from a hash of the submission, keyed with a secret of this installation (HMAC, RFC
2104): the same submission always gets the same, and nobody can compute it without the secret, which
never enters a sandbox.
"""

from __future__ import annotations

import contextlib
import hashlib
import hmac
import os
import secrets
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from grader.base.state import state_folder
from grader.course.draw import Draw, Plain

KEY_FILE = "observation.key"
KEY_BYTES = 32
MORE_TICKS = 3  # that are watched beyond the announced ones: one to this many
MORE_IF_IT_COULD_END = 24
STAY_SECONDS = (3.0, 6.0)  # of wall time, in which a node that could end must not
MOST_STAY_SECONDS = 20.0  # for a node whose source says when it ends


@dataclass(frozen=True)
class Unforeseen:
    """How a submission is observed: `draw` is its number in the sample, from 0 up to 1."""

    more_ticks: int
    stay_seconds: float
    draw: float


def unforeseen(
    sha256: str, *, could_end: bool, ends_after: float = 0, counts_to: int = 0
) -> Unforeseen:
    """Return how the submission with this hash is observed on this installation.

    `counts_to` is the number at which its source says that a count ends, 0 if it says none.
    `ends_after` is the time in seconds after which its source says that it ends, 0 if it says none.
    Longer times than MOST_STAY_SECONDS are not waited for.
    """
    digest = hmac.new(installation_key(), sha256.encode(), hashlib.sha256).digest()
    ticks, stay, draw = (int.from_bytes(digest[at : at + 8], "big") for at in (0, 8, 16))
    least, most = STAY_SECONDS
    seconds = least + stay / 2**64 * (most - least) if could_end else 0.0
    if 0 < ends_after < MOST_STAY_SECONDS:
        seconds = max(seconds, ends_after + 1)
    return Unforeseen(
        more_ticks=max(counts_to, 1 + ticks % (MORE_IF_IT_COULD_END if could_end else MORE_TICKS)),
        stay_seconds=seconds,
        draw=draw / 2**64,
    )


def drawn_for(sha256: str, draws: Mapping[str, Draw]) -> dict[str, Plain]:
    """Return the values that the submission with this hash gets on this installation.

    Each name has a draw of its own: another name beside it changes nothing.
    """
    found = {}
    for name, draw in draws.items():
        text = f"{sha256} draw {name}".encode()
        digest = hmac.new(installation_key(), text, hashlib.sha256).digest()
        values = draw.values
        found[name] = values[int.from_bytes(digest[:16], "big") % len(values)]
    return found


@cache
def installation_key() -> bytes:
    """Return the secret of this installation; one for this process if none can be kept."""
    file = state_folder() / KEY_FILE
    with contextlib.suppress(OSError):
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=file.parent) as new:  # readable by the owner only
            new.write(secrets.token_bytes(KEY_BYTES))
            new.flush()
            with contextlib.suppress(FileExistsError):
                os.link(new.name, file)  # complete, or not at all
    with contextlib.suppress(OSError):
        kept = file.read_bytes()
        if len(kept) == KEY_BYTES:
            return kept
    return secrets.token_bytes(KEY_BYTES)
