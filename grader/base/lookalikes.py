"""Letters of other alphabets that look like Latin ones (Unicode TR 39, the most frequent)."""

from __future__ import annotations

CYRILLIC = dict(zip("асеорхуіјѕһԁԛѡ", "aceopxyijshdqw"))
CYRILLIC_CAPITALS = dict(zip("АВЕКМНОРСТХУІЈЅ", "ABEKMHOPCTXYIJS"))
GREEK = dict(zip("οανρι", "oavpi"))
GREEK_CAPITALS = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "ABEZHIKMNOPTYX"))
LATIN: dict[str, str] = {**CYRILLIC, **CYRILLIC_CAPITALS, **GREEK, **GREEK_CAPITALS}
"""The Latin letter by the letter that looks like it."""
