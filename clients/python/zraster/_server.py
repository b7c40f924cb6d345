"""Calls that a server draws instead: POST /v1/render."""
from __future__ import annotations

import contextlib
import copy
import json
import os
import socket
import threading
import uuid
from http.client import HTTPConnection, HTTPSConnection
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple
from urllib.error import HTTPError, URLError
from urllib.parse import urlencode
from urllib.request import HTTPHandler, HTTPSHandler, build_opener
from urllib.request import Request as HttpRequest

from . import _options
from ._arrays import Parts, dump
from ._errors import Cancelled, Error, OptionError, SceneError, ServerError, expect, snake, words
from ._picture import Picture, from_answer, joined
from ._request import Request, outputs_query
from ._renderer import Cancel, shared

TYPES = {400: OptionError, 422: SceneError, 415: SceneError}


def _media_type(type_: Optional[str]) -> str:
    for row in shared().tables["formats"]:
        if type_ == row["suffix"]:
            return str(row["types"].split()[0])
    return type_ or "application/octet-stream"


def _multipart(body: bytes, type_: str, parts: Parts) -> Tuple[bytes, str]:
    boundary = uuid.uuid4().hex
    pieces: List[bytes] = []
    for name, data, kind in [("scene", body, type_)] + [(n, d, "") for n, d in parts.files().items()]:
        head = f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"\r\n'
        head += "Zraster-Use: optional\r\n" if name in parts.optional else ""
        head += f"Content-Type: {kind}\r\n\r\n" if kind else "\r\n"
        pieces += [head.encode("utf-8", "surrogateescape"), data, b"\r\n"]
    pieces.append(f"--{boundary}--\r\n".encode())
    return b"".join(pieces), f"multipart/form-data; boundary={boundary}"


def _error_of(status: int, text: bytes) -> Error:
    try:
        problem = json.loads(text)
        faults = [(item.get("pointer", ""), words(item["detail"])) for item in problem.get("errors", ())]
        detail = words(problem["detail"])
    except (ValueError, KeyError, TypeError):
        return ServerError(f"status {status}: {text[:200]!r}")
    lines = [f"{pointer}: {fault}" if pointer else fault for pointer, fault in faults]
    kind = TYPES.get(status, ServerError)
    if status == 400 and "parameter" not in problem["detail"]:
        kind = SceneError
    return kind("\n".join(lines) or detail, faults or [("", detail)])


Answer = Tuple[bytes, str, str, List[str]]


class _Connections(HTTPHandler, HTTPSHandler):
    """Opens addresses, and can end their connections from another thread."""

    def __init__(self) -> None:
        HTTPSHandler.__init__(self)
        self._opened: List[Any] = []

    def _open(self, kind: Any) -> Any:
        def connect(host: str, **options: Any) -> Any:
            self._opened.append(kind(host, **options))
            return self._opened[-1]

        return connect

    def http_open(self, request: Any) -> Any:
        return self.do_open(self._open(HTTPConnection), request)

    def https_open(self, request: Any) -> Any:
        return self.do_open(self._open(HTTPSConnection), request)

    def end(self) -> None:
        for connection in self._opened:
            with contextlib.suppress(AttributeError, OSError):  # it has no socket any more
                connection.sock.shutdown(socket.SHUT_RDWR)


def _until(cancel: Optional[Cancel], call: Callable[[_Connections], Answer]) -> Answer:
    """Returns the result of a call, or ends its connections once the Cancel is raised: the daemon then stops drawing."""
    connections = _Connections()
    if cancel is None:
        return call(connections)
    results: List[Any] = []

    def run() -> None:
        try:
            results.append(call(connections))
        except BaseException as error:
            results.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        while thread.is_alive():
            thread.join(0.01)
            if cancel._is_raised:
                raise Cancelled("the call was cancelled")
    except BaseException:
        connections.end()
        raise
    if isinstance(results[0], BaseException):
        raise results[0]
    return results[0]  # type: ignore[no-any-return]


def _post(server: str, body: bytes, type_: str, query: Dict[str, str], connections: _Connections) -> Answer:
    """Returns the answer, its type, its look and its warnings."""
    address = server if "://" in server else "http://" + server
    url = f"{address.rstrip('/')}/v1/render" + (f"?{urlencode(query)}" if query else "")
    headers = {"Content-Type": type_}
    if os.environ.get("ZRASTER_TOKEN"):
        headers["Authorization"] = "Bearer " + os.environ["ZRASTER_TOKEN"]
    try:
        with build_opener(connections).open(HttpRequest(url, body, headers)) as answer:
            listed = answer.headers.get("Zraster-Warnings", "")
            warnings = listed.split("; ") if listed else []
            return answer.read(), answer.headers.get_content_type(), answer.headers.get("Zraster-Look", ""), warnings
    except HTTPError as error:
        raise _error_of(error.code, error.read()) from None
    except (URLError, OSError) as error:
        reason = getattr(error, "reason", error)
        raise ServerError(f"nothing answers at {address} ({reason}); leave out server to render here") from None


def _only_channel(body: bytes, query: Dict[str, str]) -> str:
    """Returns the channel of a scene's only output."""
    if "channel" in query:
        return query["channel"]
    scene = json.loads(body)
    listed = scene.get("outputs") if isinstance(scene, dict) else None
    return str(listed[0]["channel"]) if listed else "color"


class _Calls:
    """Calls of a server, which a Cancel may end."""

    def __init__(self, server: str, cancel: Optional[Cancel]) -> None:
        self._server, self._cancel = server, cancel

    def post(self, body: bytes, type_: str, parts: Parts, query: Dict[str, str]) -> Answer:
        if parts:
            body, type_ = _multipart(body, type_, parts)
        return _until(self._cancel, lambda connections: _post(self._server, body, type_, query, connections))

    def scene(self, request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Picture:
        merged = request.merged({}, keys)
        data, content_type, look, warnings = self.post(merged.body, "application/json", merged.parts, query)
        return from_answer(data, content_type, _only_channel(merged.body, query), look, warnings)

    def mesh(self, request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Picture:
        outputs = keys.pop("outputs", None)
        pictures = []
        lists = [[output] for output in outputs or [{}]]
        if outputs and all(output.keys() <= {"channel", "x", "y"} for output in outputs):
            lists = [outputs]  # one answer, as of a call without a server: info tells of the picture
        for listed in lists:
            asked = {**query, **(outputs_query(listed) if outputs else {})}
            data, type_, look, warnings = self.post(request.body, _media_type(request.type), request.parts, asked)
            pictures.append(from_answer(data, type_, asked.get("channel", "color"), look, warnings))
        return pictures[0] if len(pictures) == 1 else joined(pictures)


def render(
    server: str, request: Request, query: Dict[str, str], keys: Dict[str, Any], cancel: Optional[Cancel] = None
) -> Picture:
    expect(isinstance(server, str), "server", "an address such as 'http://127.0.0.1:8080'", server)
    expect(cancel is None or isinstance(cancel, Cancel), "cancel", "a Cancel", cancel)
    calls = _Calls(server, cancel)
    if not request.source.is_mesh:
        return calls.scene(request, query, keys)
    more, rest = _parameters(keys)
    if not rest.keys() - {"outputs"}:
        return calls.mesh(request, {**query, **more}, rest)
    return calls.scene(*_as_scene(request, query, keys))


# ---- keys of scenes for meshes ----


def _leaves(pointer: str, value: Any, known: Any) -> Iterator[Tuple[str, Any]]:
    """Yields the values below a JSON Pointer: those of known pointers whole."""
    items: Any = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, (list, tuple)) else ()
    if pointer in known or not items or not len(value):
        yield pointer, value
        return
    for key, item in items:
        yield from _leaves(f"{pointer}/{key}", item, known)


def _parameters(keys: Dict[str, Any]) -> Tuple[Dict[str, str], Dict[str, Any]]:
    """Splits keys into the parameters that set them and other keys."""
    rows = [row for row in _options.rows().values() if row.name and row.is_mesh]
    known = {row.pointer: row.name for row in rows if not row.pointer.startswith("/view/")}  # a view replaces the look's
    query: Dict[str, str] = {}
    rest: Dict[str, Any] = {}
    for key, value in keys.items():
        leaves = dict(_leaves(f"/{key}", value, known))
        if leaves.keys() <= known.keys() and not any(map(_options._has_objects, leaves.values())):
            query.update({known[pointer]: _options._text(key, leaf) for pointer, leaf in leaves.items()})
        else:
            rest[key] = value
    return query, rest


_UPRIGHT = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]  # z becomes y, as for bare meshes whose z points up
_TEXTS = {"NAME", "COLOR", "BACKGROUND"}  # kinds of parameters whose value is the key's text


def _value(kind: str, text: str) -> Any:
    """Returns the value of a key for the text of a parameter."""
    if kind in ("PARTS", "PRESETS", "WORDS"):
        return text.split(",")
    if kind == "VECTOR":
        return [float(number) for number in text.split(",")]
    if kind in _TEXTS:
        return text
    try:
        return json.loads(text)
    except ValueError:
        return text


def _z_is_up(request: Request) -> bool:
    """True for STL and 3MF, as the renderer detects them."""
    body, type_ = request.body, request.type
    is_stl = body[:5] == b"solid" or len(body) == 84 + 50 * int.from_bytes(body[80:84], "little")
    return type_ in ("stl", "3mf") if type_ else is_stl or body[:2] == b"PK"


def _as_scene(request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Tuple[Request, Dict[str, str], Dict[str, Any]]:
    """Returns a request for a scene of the mesh, in the look studio, which has the same pixels and takes all keys."""
    name = f"model.{request.type}" if request.type else "model"
    scene: Dict[str, Any] = {"look": "studio", "meshes": [{"asset": name}]}
    if _z_is_up(request):
        scene["nodes"] = [{"mesh": 0, "matrix": _UPRIGHT}]
    left = {}
    for row in _options.rows().values():
        if row.name not in query or not row.name:
            continue
        if not row.is_mesh:
            left[row.name] = query[row.name]
        elif row.pointer.startswith(("/query/", "/materials/")) or row.kind == "PLANES":
            raise OptionError(f"{snake(row.name)}: with server= and {', '.join(keys)}, a mesh does not take it; a scene does")
        else:
            _options._set(scene, row.pointer, _value(row.kind, query[row.name]))
    made = copy.copy(request)
    made.parts = Parts(request.parts.named)
    made.parts.optional = set(request.parts.optional)
    made.parts.named[name] = request.body
    made.source = copy.copy(request.source)
    made.source.is_mesh = False
    made.body = dump(scene, made.parts)
    return made, left, keys
