"""Figures from a dataset, and files from figures."""

import contextlib
import multiprocessing
import os
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from foldwing.plots.catalogue import films, pictures

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

_DOTS_PER_INCH = 144
_FRAME_DOTS_PER_INCH = 90
_QUICK: Mapping[str, dict[str, Any]] = {"png": {"pil_kwargs": {"compress_level": 3}}}
"""Settings by format: half the time of the default for files a tenth larger."""
_FRAME_MILLISECONDS = 50


def static_figures(dataset: "xarray.Dataset", theme: str = "light") -> "dict[str, Figure]":
    """Return every picture of a dataset as a matplotlib figure.

    Parameters
    ----------
    dataset : xarray.Dataset
    theme : str
        ``light`` or ``dark``.

    Returns
    -------
    dict
        Name of the picture -> figure; names serve as stems of files.
    """
    from foldwing.plots.static import draw

    return {picture.name: draw(picture, theme) for picture in pictures(dataset)}


def interactive_figures(
    dataset: "xarray.Dataset", theme: str = "light"
) -> list[tuple[str, str, dict[str, Any]]]:
    """Return (title, caption, figure) of every picture, for plotly.

    A figure is plain JSON data: ``plotly.graph_objects.Figure(figure)`` or
    ``plotly.io.show(figure)`` take it as it is.
    """
    from foldwing.plots.interactive import colored, figure

    shown = [picture for picture in pictures(dataset) if picture.name != "flutter-motion"]
    return [
        (picture.title, picture.caption, colored(figure(picture), theme))
        for picture in [*shown, *films(dataset)]
    ]


def write_pictures(
    dataset: "xarray.Dataset",
    folder: Path,
    themes: Sequence[str] = ("light",),
    formats: Sequence[str] = ("png", "svg"),
) -> list[str]:
    """Write every picture of a dataset and return the names of the files.

    Parameters
    ----------
    dataset : xarray.Dataset
    folder : Path
        An existing folder.
    themes : sequence of str
        ``light`` (``name.png``) and ``dark`` (``name-dark.png``). The report shows both.
    formats : sequence of str
        ``png``, ``svg`` or ``pdf``.
    """
    figures = {
        f"{name}{'' if theme == 'light' else f'-{theme}'}": figure
        for theme in themes
        for name, figure in static_figures(dataset, theme).items()
    }
    first, rest = list(formats[:1]), list(formats[1:])
    with _beside(lambda: _save(figures, folder, rest)):
        _save(figures, folder, first)
    return [f"{name}.{extension}" for name in figures for extension in formats]


def _save(figures: "Mapping[str, Figure]", folder: Path, formats: Sequence[str]) -> None:
    for extension in formats:
        for name, figure in figures.items():
            settings = _QUICK.get(extension, {})
            figure.savefig(folder / f"{name}.{extension}", dpi=_DOTS_PER_INCH, **settings)


@contextlib.contextmanager
def _beside(work: Callable[[], None]) -> Iterator[None]:
    """Do work in a second process while the block runs; after it where that is not possible.

    Drawing twice takes as long as everything else of a small study. A copy of this process needs no
    start and no imports, but only Linux makes one safely.
    """
    if sys.platform != "linux" or (os.cpu_count() or 1) < 2 or threading.active_count() > 1:
        yield
        work()
        return
    process = multiprocessing.get_context("fork").Process(target=work)
    process.start()
    yield
    process.join()
    if process.exitcode:
        work()


def write_report(dataset: "xarray.Dataset", path: Path) -> None:
    """Write all pictures, tables and the provenance into one HTML file that needs no network."""
    from foldwing.plots import report

    report.write_report(dataset, path)


def write_animation(dataset: "xarray.Dataset", path: Path, theme: str = "light") -> bool:
    """Write the motion at the lowest flutter onset as an animated GIF.

    Returns
    -------
    bool
        False, and nothing written, when the dataset holds no motion.
    """
    from dataclasses import replace

    from PIL import Image

    from foldwing.plots.picture import Scene, Surface
    from foldwing.plots.static import draw

    film = next(iter(films(dataset)), None)
    scene = film.panels[0] if film else None
    if film is None or not isinstance(scene, Scene):
        return False
    fixed = [item for item in scene.items if not isinstance(item, Surface) or item.values is None]
    images = []
    for frame in film.frames:
        still = replace(film, panels=[replace(scene, items=[*fixed, *frame])])
        figure = draw(still, theme)
        figure.set_dpi(_FRAME_DOTS_PER_INCH)
        figure.canvas.draw()
        images.append(Image.fromarray(_pixels(figure)))
    images[0].save(
        path, save_all=True, append_images=images[1:], duration=_FRAME_MILLISECONDS, loop=0
    )
    return True


def _pixels(figure: Any) -> Any:
    import numpy as np

    return np.asarray(figure.canvas.buffer_rgba())[..., :3]
