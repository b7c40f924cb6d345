"""Several views of a scene, drawn by one request."""
from __future__ import annotations

import os
from collections.abc import Sequence as AbstractSequence
from typing import Any, Callable, Dict, List, Optional, Tuple

from ._arrays import load_numpy, npy
from ._errors import OptionError, SceneError
from ._files import frames, spelled, suffix_of, zip_files
from ._options import outputs_of
from ._picture import Files, Picture

SHEET_MAX = 64  # views that a notebook shows as a sheet

Draw = Callable[..., Picture]  # draws the views, with outputs and other keywords


class Views(AbstractSequence):  # type: ignore[type-arg]
    """Several views: a sequence of Pictures, in the order of `names`.

    views[0], for picture in views: the Picture of a view; its pixels are those of Scene.render for the view alone
    views["depth"]: (n, h, w) float32; views["color"]: (n, h, w, 3) uint8; all windows have one size
    sheet(...), animation(...): all of them as one Picture
    Notebooks show a turntable as an animation, and other views as a sheet.
    """

    def __init__(self, names: List[str], is_turn: bool, channels: Any, draw: Draw) -> None:
        self.names, self._is_turn, self._draw = list(names), is_turn, draw
        outputs = outputs_of("color" if channels is None else channels)
        self._outputs = [{"encoding": "apng", **output} if is_turn and self._is_color(output) else output for output in outputs]
        self._made: Dict[str, Picture] = {}
        self._drawn = draw(self._outputs)
        self._drawn._warn(5)  # at the caller of Scene.views
        self._frames: Optional[List[bytes]] = None

    @staticmethod
    def _is_color(output: Dict[str, Any]) -> bool:
        return output["channel"] == "color"

    def _file(self, number: int, channel: str) -> Tuple[bytes, str]:
        """Returns the file of a view's channel, and its type."""
        found = self._drawn._made.encode(f"{self.names[number]}.{channel}")
        if found:
            return found  # type: ignore[no-any-return]
        data, type_ = self._drawn._encode(channel)
        if type_ == "image/apng":
            self._frames = self._frames or frames(data)
            return self._frames[number], "image/png"
        if type_ == "application/x-npy":
            return npy(self._drawn.view(channel)[number]), type_
        raise OptionError(f"{channel}: a view of an animation in {type_} is no file of its own; ask for it without the encoding")

    # ---- views ----

    def __len__(self) -> int:
        return len(self.names)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return self._array(key)
        if isinstance(key, slice):
            return [self[i] for i in range(*key.indices(len(self)))]
        if not -len(self) <= key < len(self):
            raise IndexError(f"view {key} of {len(self)}")
        files = {output["channel"]: self._file(key % len(self), output["channel"]) for output in self._outputs}
        only = next(iter(files.values()))
        if len(files) > 1:
            only = (zip_files({name + suffix_of(type_): data for name, (data, type_) in files.items()}), "application/zip")
        picture = Picture(Files(only, files, self.look, self.warnings))
        picture._issued = len(self.warnings)  # by the drawing of all
        return picture

    def _array(self, channel: str) -> Any:
        numpy = load_numpy()

        if channel not in [output["channel"] for output in self._outputs]:
            raise KeyError(f"{channel}: the views have {', '.join(o['channel'] for o in self._outputs)}")
        arrays = [picture.view(channel) for picture in self]
        if len({array.shape for array in arrays}) > 1:
            raise OptionError(f"{channel}: the windows of the views differ; views[0]['{channel}'] is that of one")
        return numpy.stack(arrays)

    @property
    def array(self) -> Any:
        """Array of color, or of the first channel, with an axis for the views."""
        names = [output["channel"] for output in self._outputs]
        return self["color" if "color" in names else names[0]]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> Any:
        return self.array if dtype is None else self.array.astype(dtype)

    # ---- pictures of all views ----

    def _joined(self, kind: str, output: Dict[str, Any], options: Dict[str, Any]) -> Picture:
        if kind not in self._made:
            picture = self._made[kind] = self._draw([output], **options)
            picture._issued = len(picture.warnings)  # by the drawing before
        return self._made[kind]

    def sheet(self, size: Any = None, **options: Any) -> Picture:
        """Draws all views into one picture at one scale. size: of the picture; options: sheet_columns, look, ..."""
        if size is not None:
            options["size"] = size
        options = {"sheet": "views", **options}
        return self._joined(repr(sorted(options.items())), {"channel": "color"}, options)

    def animation(self, encoding: str = "apng", **output: Any) -> Picture:
        """Draws all views as frames. encoding: "apng", or "webp" or "gif" of a turntable; output: quality=80 or
        lossless=True for webp."""
        if encoding not in ("apng", "webp", "gif") or (encoding != "apng" and not self._is_turn):
            raise OptionError(f"encoding: {encoding!r}: apng is allowed{', and webp and gif' if self._is_turn else ''}")
        if encoding == "apng" and [o.get("encoding") for o in self._outputs] == ["apng"]:
            return self._drawn
        return self._joined(repr((encoding, sorted(output.items()))), {"channel": "color", "encoding": encoding, **output}, {})

    def save(self, path: Any) -> None:
        """Writes files by the ending of the path: .png: the animation of a turntable, else the sheet; .apng, .webp, .gif:
        the animation; .npz: arrays by channel; .npy: the only channel; .zip: a file for each view and channel, which a path that
        ends with / writes into that folder."""
        name = os.fspath(path)
        suffix = os.path.splitext(name)[1].lower()
        suffix = spelled(suffix)
        if suffix in (".apng", ".webp", ".gif"):
            data = self.animation(suffix[1:]).content
        elif suffix == ".png":
            data = (self.animation() if self._is_turn else self.sheet()).content
        elif suffix in (".npz", ".npy"):
            return self._save_arrays(path, suffix)
        elif suffix == ".zip":
            data = zip_files(self._files())
        elif name.endswith(os.sep) or os.path.isdir(name):
            os.makedirs(name, exist_ok=True)
            for file, content in self._files().items():
                _write(os.path.join(name, file), content)
            return None
        else:
            raise OptionError(f"{name}: views have no file for this ending, but .png, .apng, .webp, .gif, .npz, .npy and .zip")
        return _write(path, data)

    def _save_arrays(self, path: Any, suffix: str) -> None:
        numpy = load_numpy()

        names = [output["channel"] for output in self._outputs]
        if suffix == ".npz":
            numpy.savez(path, **{name: self[name] for name in names})
        elif len(names) == 1:
            numpy.save(path, self[names[0]])
        else:
            raise OptionError(f"{os.fspath(path)}: .npy has one channel, and the views have {', '.join(names)}: .npz has all")

    def _files(self) -> Dict[str, bytes]:
        files: Dict[str, bytes] = {}
        for number, name in enumerate(self.names):
            for output in self._outputs:
                data, type_ = self._file(number, output["channel"])
                files[f"{name}.{output['channel']}{suffix_of(type_)}"] = data
        return files

    def _repr_png_(self) -> Optional[bytes]:
        if not any(map(self._is_color, self._outputs)) or len(self) > SHEET_MAX and not self._is_turn:
            return None
        try:
            return self.animation().content if self._is_turn else self.sheet().content
        except SceneError:  # no room for a sheet, or windows that differ
            return None

    # ---- facts ----

    @property
    def look(self) -> str:
        """The look and its version, such as "studio@1"."""
        return self._drawn.look

    @property
    def warnings(self) -> List[str]:
        """Texts of all warnings."""
        return self._drawn.warnings

    def __repr__(self) -> str:
        return f"<zraster.Views: {len(self)} of {', '.join(output['channel'] for output in self._outputs)} in {self.look}>"


def _write(path: Any, data: bytes) -> None:
    with open(path, "wb") as file:
        file.write(data)
