"""Calls that a server draws instead: POST /v1/render."""
from __future__ import annotations

import json
import os
import uuid
from typing import Any, Dict, List, Optional, Tuple
from urllib.error import HTTPError, URLError
from urllib.parse import urlencode
from urllib.request import Request as HttpRequest
from urllib.request import urlopen

from ._arrays import Parts
from ._errors import Error, OptionError, SceneError, ServerError, expect, words
from ._picture import Picture, from_answer, joined
from ._request import Request, outputs_query
from ._renderer import shared

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


def _post(server: str, body: bytes, type_: str, query: Dict[str, str]) -> Tuple[bytes, str, str, List[str]]:
    """Returns the answer, its type, its look and its warnings."""
    address = server if "://" in server else "http://" + server
    url = f"{address.rstrip('/')}/v1/render" + (f"?{urlencode(query)}" if query else "")
    headers = {"Content-Type": type_}
    if os.environ.get("ZRASTER_TOKEN"):
        headers["Authorization"] = "Bearer " + os.environ["ZRASTER_TOKEN"]
    try:
        with urlopen(HttpRequest(url, body, headers)) as answer:
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


def _render_scene(server: str, request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Picture:
    merged = request.merged({}, keys)
    body, type_ = merged.body, "application/json"
    if merged.parts:
        body, type_ = _multipart(body, type_, merged.parts)
    data, content_type, look, warnings = _post(server, body, type_, query)
    return from_answer(data, content_type, _only_channel(merged.body, query), look, warnings)


def _render_mesh(server: str, request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Picture:
    outputs = keys.pop("outputs", None)
    if keys:
        raise OptionError(f"{', '.join(keys)}: with server=, a mesh has parameters only; zraster.options() lists them")
    body, type_sent = request.body, _media_type(request.type)
    if request.parts:
        body, type_sent = _multipart(body, type_sent, request.parts)
    pictures = []
    for output in outputs or [{}]:
        asked = {**query, **(outputs_query([output]) if output else {})}
        data, type_, look, warnings = _post(server, body, type_sent, asked)
        pictures.append(from_answer(data, type_, asked.get("channel", "color"), look, warnings))
    return pictures[0] if len(pictures) == 1 else joined(pictures)


def render(server: str, request: Request, query: Dict[str, str], keys: Dict[str, Any]) -> Picture:
    expect(isinstance(server, str), "server", "an address such as 'http://127.0.0.1:8080'", server)
    if request.source.is_mesh:
        return _render_mesh(server, request, query, dict(keys))
    return _render_scene(server, request, query, keys)
