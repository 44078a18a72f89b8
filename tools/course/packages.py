"""Names Debian's packages as Homebrew, npm and pip do, for systems without apt."""

# Homebrew's names.
BREW = {"cmake": "cmake", "ninja-build": "ninja", "git": "git", "libeigen3-dev": "eigen", "libgtest-dev": "googletest",
        "libcli11-dev": "cli11", "nlohmann-json3-dev": "nlohmann-json", "nodejs": "node", "pybind11-dev": "pybind11",
        "python3-dev": "python", "clang-format": "clang-format", "codespell": "codespell", "libbullet-dev": "bullet",
        "libode-dev": "ode", "libdart-collision-ode-dev": "dartsim", "emscripten": "emscripten",
        "fonts-linuxlibertine": "font-linux-libertine"}
# Of the Python modules, which go into a virtual environment of the course's own.
PIP = {"python3-numpy": "numpy", "python3-matplotlib": "matplotlib", "python3-markdown-it": "markdown-it-py",
       "python3-mdit-py-plugins": "mdit-py-plugins", "python3-pygments": "pygments", "python3-selenium": "selenium",
       "python3-fonttools": "fonttools", "python3-brotli": "brotli"}
# Of the libraries that run in a browser; this three.js is the one of Debian, with which the viewer is tested.
NPM = {"libjs-three": "three@0.111.0", "libjs-katex": "katex@0.16"}
# What Apple gives in place of Debian's compilers.
APPLE = ("g++", "clang")
# Homebrew lacks these. All but MuJoCo are for commands that need Linux.
LINUX_ONLY = ("bubblewrap", "libarchive-tools", "libclang-rt-dev", "slurm-wlm", "munge", "chromium", "chromium-driver",
              "libmujoco-dev")


def split(packages: list[str], names: dict[str, str]) -> tuple[list[str], list[str]]:
    """Splits packages into those that `names` has, by their names there, and the rest."""
    return [names[package] for package in packages if package in names], [
        package for package in packages if package not in names]
