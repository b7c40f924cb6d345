"""python3 -m zraster.pyrender SCRIPT.py [ARGUMENT ...]: runs a script for pyrender as it is."""
import os
import runpy
import sys

from . import install

if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python3 -m zraster.pyrender SCRIPT.py [ARGUMENT ...]")
    install()
    del sys.argv[0]
    sys.path[0] = os.path.dirname(os.path.abspath(sys.argv[0]))
    runpy.run_path(sys.argv[0], run_name="__main__")
