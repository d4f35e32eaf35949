"""The files in the layers of an image, including those that a later layer hides."""

from __future__ import annotations

import re
import tarfile
import tempfile
from dataclasses import dataclass
from typing import IO

from docker.models.images import Image

CERTIFICATE = re.compile(
    rb"-----BEGIN (?:TRUSTED )?CERTIFICATE-----(.+?)-----END (?:TRUSTED )?CERTIFICATE-----",
    re.DOTALL,
)

PUBLIC = "usr/share/ca-certificates/mozilla/"


@dataclass(frozen=True)
class Layers:
    """The files' names without a leading slash, and the certificates (PEM bodies) in them.

    `public` are those of the package ca-certificates, from its own folder.
    """

    names: frozenset[str]
    certificates: frozenset[bytes]
    public: frozenset[bytes]


def certificates_in(data: bytes) -> frozenset[bytes]:
    """Return the bodies of the PEM certificates, joined across their line breaks."""
    return frozenset(b"".join(body.split()) for body in CERTIFICATE.findall(data))


def layers_of(image: Image) -> Layers:
    """Read all layers of an image."""
    names: set[str] = set()
    certificates: set[bytes] = set()
    public: set[bytes] = set()
    with tempfile.TemporaryFile() as packed:
        for piece in image.save():
            packed.write(piece)
        packed.seek(0)
        with tarfile.open(fileobj=packed) as archive:
            for member in archive:
                if member.name.endswith("layer.tar") or member.name.startswith("blobs/"):
                    layer = archive.extractfile(member)
                    assert layer is not None
                    _read(layer, names, certificates, public)
    assert any(name.startswith("opt/ros/") for name in names), "no layer could be read"
    return Layers(frozenset(names), frozenset(certificates), frozenset(public))


def _read(layer: IO[bytes], names: set[str], certificates: set[bytes], public: set[bytes]) -> None:
    try:
        with tarfile.open(fileobj=layer) as files:
            for file in files:
                names.add(file.name)
                opened = files.extractfile(file) if file.isfile() else None
                if opened is not None:
                    found = certificates_in(opened.read())
                    certificates |= found
                    if file.name.startswith(PUBLIC):
                        public |= found
    except tarfile.ReadError:
        return  # this blob is the image's configuration, not a layer
