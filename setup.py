"""Packs the Python package for the installed cv2, which CMake builds: `pip install --no-build-isolation .`

Environment:
  OPENCV_TS_SOURCE_DIR  source tree of the installed OpenCV; default: what scripts/get_opencv_source.sh has fetched
  CMAKE_ARGS            options for CMake
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys

import setuptools
from setuptools.command.build_ext import build_ext

try:
    import numpy
except ImportError:
    sys.exit('The package is built for the numpy that it will run with: install numpy, and give pip --no-build-isolation')

ROOT = pathlib.Path(__file__).resolve().parent
# Of setuptools and of CMake; one folder below the sources, as other builds, whose objects ccache finds by relative paths.
BUILD = ROOT / 'build-wheel'


def opencv_source():
    """Empty if there is none: CMake says what to do."""
    fetched = [ROOT / 'scripts' / 'get_opencv_source.sh', '--fetched']
    return (os.environ.get('OPENCV_TS_SOURCE_DIR') or
            subprocess.run(fetched, stdout=subprocess.PIPE, text=True, check=False).stdout.strip())


class BuildWithCMake(build_ext):
    def build_extension(self, ext):
        # What CMake has found may be of another Python, or of an environment that is gone.
        (BUILD / 'CMakeCache.txt').unlink(missing_ok=True)
        # The library is linked statically, so that the extension is all there is to find.
        self.spawn(['cmake', '-S', str(ROOT), '-B', str(BUILD), *shlex.split(os.environ.get('CMAKE_ARGS', '')),
                    '-DBUILD_PYTHON=ON', '-DBUILD_SHARED_LIBS=OFF', '-DBUILD_SAMPLES=OFF', '-DRSACKERMANN_PYTHON_DIR=.',
                    '-DPython3_EXECUTABLE=' + sys.executable, '-DOPENCV_TS_SOURCE_DIR=' + opencv_source()])
        os.environ.setdefault('CMAKE_BUILD_PARALLEL_LEVEL', str(os.cpu_count()))
        self.spawn(['cmake', '--build', str(BUILD), '--target', 'rsackermann_python'])
        self.spawn(['cmake', '--install', str(BUILD), '--component', 'python', '--strip',
                    '--prefix', os.path.abspath(self.build_lib)])


BUILD.mkdir(exist_ok=True)
version, description = re.search(r'^project\(rsackermann VERSION (\S+) .*DESCRIPTION "(.*)"\)',
                                 (ROOT / 'CMakeLists.txt').read_text(encoding='utf-8'), re.M).groups()
# An extension runs with the numpy that it was built with and with later ones of the same major version.
numpy_major, numpy_minor = map(int, numpy.__version__.split('.')[:2])
setuptools.setup(
    version=version,
    description=description,
    packages=[],  # all files come from CMake
    install_requires=['numpy>=%d.%d,<%d' % (numpy_major, numpy_minor, numpy_major + 1)],
    ext_modules=[setuptools.Extension('rsackermann.bindings', sources=[])],
    cmdclass={'build_ext': BuildWithCMake},
    options={'build': {'build_base': str(BUILD)}, 'egg_info': {'egg_base': str(BUILD)}})
