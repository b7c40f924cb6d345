"""The version of zraster."""
from .. import __version__

__all__ = ["__version__"]
