"""Builds the wheel of package keyline with CMake and nothing else: a backend of its own (PEP 517), so
that pip needs no network. What it needs is installed by `./dev setup` (compiler, libraries, pybind11-dev,
python3-dev); NumPy is needed to run the package.

KEYLINE_BUILD=FOLDER takes the module from a build tree that exists instead of making one.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def _version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(keyline VERSION ([0-9.]+)", text).group(1)


def _build():
    """The folder of the package, built."""
    given = os.environ.get("KEYLINE_BUILD")
    folder = Path(given) if given else ROOT / "build" / "wheel"
    if not given:
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DKEYLINE_TESTS=OFF", f"-DPython_EXECUTABLE={_python()}"]
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", *options], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "keyline_python_stubs"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "keyline-cad"], check=False)  # where OCCT is
    return folder


def _python():
    """The interpreter whose headers are there: a venv's own is a link to it."""
    return Path(sys.executable).resolve()


def _metadata():
    return (
        f"Metadata-Version: 2.1\nName: keyline\nVersion: {_version()}\n"
        "Summary: Aesthetic curves and surfaces\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
    )


def _record(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517."""
    folder = _build()
    files = {}
    for path in sorted((folder / "bindings" / "python" / "keyline").rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            files[f"keyline/{path.name}"] = path.read_bytes()
    cad = folder / "apps" / "keyline" / "keyline-cad"
    if cad.exists():  # reads and writes STEP and IGES, found beside the module
        files["keyline/keyline-cad"] = cad.read_bytes()
    info = f"keyline-{_version()}.dist-info"
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: keyline\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-{platform}\n"
    ).encode()
    record = "".join(_record(name, data) for name, data in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    name = f"keyline-{_version()}-{tag}-{tag}-{platform}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if path.endswith("keyline-cad") else 0o100644) << 16
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """PEP 517; the source is the repository."""
    raise RuntimeError("keyline is built from its repository: there is no source distribution")
