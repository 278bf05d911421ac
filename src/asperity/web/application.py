"""The addresses of the application: pages, static files, uploads, and the files of runs that it
gives out."""

from __future__ import annotations

from importlib import resources
from typing import Any

from fastapi import FastAPI, Request
from fastapi.responses import FileResponse, JSONResponse, Response
from nicegui import ui

from ..core.errors import AsperityError
from ..report import page
from ..run.document import EXAMPLES, picture
from .kept import is_within
from .pages import add_pages
from .security import MIB, quota_text
from .session import Place
from .views import SCENE

SANDBOX = (
    "sandbox allow-scripts allow-popups; default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; img-src data:"
)
"""Policy of a report, which has scripts of its own: it sees nothing of the application."""

TYPES = {
    ".html": "text/html",
    ".png": "image/png",
    ".csv": "text/csv",
    ".toml": "text/plain",
    ".nc": "application/x-netcdf",
}
"""Types of files that are given out; all others are bytes."""


def application(place: Place) -> Any:
    """The pages over ``place``, as an ASGI application that is still to be guarded."""
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    static = {entry.name: entry.read_bytes() for entry in resources.files(__package__).joinpath("static").iterdir()}
    static |= {"viewer.js": page.script().encode(), "viewer.css": page.style().encode()}

    def no_run() -> Response:
        return Response("no such run", 404, media_type="text/plain")

    @app.get("/static/{name}")
    async def asset(name: str) -> Response:
        kind = {"js": "text/javascript", "css": "text/css"}.get(name.rpartition(".")[2])
        if name not in static or kind is None:
            return Response("no such file", 404)
        return Response(static[name], media_type=kind, headers={"cache-control": "max-age=3600"})

    @app.get("/examples/{name}.png")
    async def example(name: str) -> Response:
        if name not in EXAMPLES:
            return Response("no such example", 404, media_type="text/plain")
        return Response(picture(name), media_type="image/png", headers={"cache-control": "max-age=3600"})

    @app.get("/views/{key}/{run}")
    async def scene(key: str, run: str) -> Response:
        session, known = place.run_of(key, run)
        if session is None or known is None:
            return no_run()
        views = session.views_of(known)
        file = views.with_name(views.name + SCENE)
        if not file.is_file() or not is_within(file, session.folder):
            return Response("no maps", 404, media_type="text/plain")
        return FileResponse(file, media_type="application/json", headers={"cache-control": "no-store"})

    @app.get("/views/{key}/{run}/{name}")
    async def array(key: str, run: str, name: str) -> Response:
        """One array of the maps; one that is still being made is waited for, unless the
        application ends."""
        session, known = place.run_of(key, run)
        if session is None or known is None:
            return no_run()
        file = await session.made(known, name, lambda: not place.ends())
        if file is None:
            return Response("no such map", 404, media_type="text/plain")
        return FileResponse(file, media_type="application/octet-stream", headers={"cache-control": "no-store"})

    @app.post("/upload/{key}")
    async def upload(key: str, name: str, request: Request) -> Response:
        session = place.sessions.get(key)
        if session is None:
            return JSONResponse({"error": "This session has ended; begin a new one."}, 404)
        length = int(request.headers.get("content-length", "0"))
        if length > place.room():
            return JSONResponse({"error": quota_text(place.quota)}, 413)
        path = session.add_file(name)
        try:
            with path.open("xb") as target:
                unseen = 0
                async for part in request.stream():
                    target.write(part)
                    unseen += len(part)
                    if unseen > MIB:  # others may send something meanwhile
                        target.flush()
                        unseen = 0
                        if place.room() < 0:
                            break
            full = place.room() < 0
        except BaseException:
            session.forget_file(path)
            raise
        if full:
            session.forget_file(path)
            return JSONResponse({"error": quota_text(place.quota)}, 413)
        session.touched()
        return JSONResponse({"path": str(path)})

    @app.get("/files/{key}/{run}/{name:path}")
    async def file(key: str, run: str, name: str) -> Response:
        session = place.sessions.get(key)
        found = None if session is None else session.given_out(run).get(name)
        if found is None:
            return Response("no such file", 404, media_type="text/plain")
        kind = TYPES.get(found.suffix, "application/octet-stream")
        policy = {"content-security-policy": SANDBOX} if kind == "text/html" else {}
        return FileResponse(found, media_type=kind, headers={"cache-control": "no-store", **policy})

    @app.get("/share/{key}/{run}")
    def share(key: str, run: str) -> Response:
        session, known = place.run_of(key, run)
        if session is None or known is None:
            return no_run()
        try:
            archive = session.shared(known)
        except AsperityError as error:
            return Response(session.said(str(error)), 404, media_type="text/plain")
        return FileResponse(archive, media_type="application/zip", headers={"cache-control": "no-store"})

    add_pages(app, place)
    ui.run_with(
        app,
        title="asperity",
        dark=None,
        language="en-US",
        tailwind=False,
        gzip_middleware_factory=None,
        show_welcome_message=False,
        reconnect_timeout=20.0,
        favicon=FAVICON,
    )
    return app


FAVICON = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32"><rect width="32" height="32" rx="6" fill="#005a9c"/>'
    '<path d="M3 22l6-9 4 5 5-11 5 9 3-4 3 5" fill="none" stroke="#fff" stroke-width="2.5"/></svg>'
)
"""Picture of the application in the bar of a browser."""
