"""The command line: thin, and quick to answer ``--help``."""

from foldwing.cli.main import main

__all__ = ["main"]
