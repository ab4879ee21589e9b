# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The world of a running scipd: what is added, moved and taken away."""

from __future__ import annotations

import base64
import os
import pathlib
from typing import Any, Dict, List, Optional, Sequence, Union
from xml.sax.saxutils import quoteattr, escape

from .clock import Clock
from .control import Control, quoted
from .errors import Refused
from .pose import Pose, PoseLike
from .program import find_world

PathLike = Union[str, "os.PathLike[str]"]


def _box(name: str, size: Sequence[float], material: Optional[str]) -> str:
    """A model that stands on its origin."""
    if len(size) != 3 or not all(length > 0 for length in size):
        raise ValueError(f"a box has three lengths in metres, not {size!r}")
    made_of = f"<scipd:material>{escape(material)}</scipd:material>" if material else ""
    return (f"<model name={quoteattr(name)} xmlns:scipd='urn:scipd:sdf'><link name='body'><visual name='box'>"
            f"<pose>0 0 {size[2] / 2} 0 0 0</pose>{made_of}<geometry><box><size>{size[0]} {size[1]} {size[2]}</size>"
            "</box></geometry></visual></link></model>")


class Scene:
    def __init__(self, control: Control, clock: Clock) -> None:
        self._control = control
        self._clock = clock

    @property
    def models(self) -> List[str]:
        """The names of what there is."""
        return [model["name"] for model in self._control.get("/scene")["models"]]

    def add(self, name: str, *, box: Optional[Sequence[float]] = None, mesh: Optional[PathLike] = None,
            sdf: Optional[str] = None, file: Optional[PathLike] = None, pose: PoseLike = (0, 0, 0),
            material: Optional[str] = None, scale: Optional[float] = None, replace: bool = False) -> List[str]:
        """Adds a box of three lengths that stands on its pose, a mesh, an SDF text, or a file or folder that is a
        model. The next scan of each scanner sees it. Returns the warnings of scipd."""
        given = [what for what in (box, mesh, sdf, file) if what is not None]
        if len(given) != 1:
            raise TypeError("a model is one of box=, mesh=, sdf= and file=")
        if material is not None and (sdf is not None or file is not None):
            raise TypeError("material= goes with box= and mesh=; others say themselves what they are of")
        request: Dict[str, Any] = {"name": name, "pose": Pose.of(pose).as_json(), "replace": replace}
        if box is not None:
            request["sdf"] = _box(name, box, material)
        elif sdf is not None:
            request["sdf"] = sdf
        elif file is not None:
            request["file"] = os.path.abspath(file)
        else:
            more = {"material": material, "scale": scale}
            request.update({key: value for key, value in more.items() if value is not None})
            return self._add_mesh(request, pathlib.Path(os.path.abspath(mesh or "")))
        return self._post(request)

    def move(self, name: str, pose: PoseLike) -> None:
        self._clock.place("model", name, Pose.of(pose))

    def pose(self, name: str) -> Pose:
        return Pose.from_json(self._control.get(f"/scene/models/{quoted(name)}/pose"))

    def remove(self, name: str) -> None:
        self._control.ask("DELETE", f"/scene/models/{quoted(name)}")

    def load(self, world: PathLike) -> List[str]:
        """Another world in the place of this one: a file or folder, or the name of a scene that ships with scipd."""
        file = os.path.abspath(find_world(world))
        return list(self._control.ask("PUT", "/scene", {"file": file})["warnings"])

    def _add_mesh(self, request: Dict[str, Any], file: pathlib.Path) -> List[str]:
        try:
            return self._post({**request, "mesh": str(file)})
        except Refused as refused:
            if refused.status != 403:
                raise
        # scipd reads files of few folders only. The bytes may come from anywhere, but name no other file.
        data = base64.b64encode(file.read_bytes()).decode()
        return self._post({**request, "mesh_data": data, "mesh_format": file.suffix[1:]})

    def _post(self, request: Dict[str, Any]) -> List[str]:
        return list(self._control.ask("POST", "/scene/models", request)["warnings"])
