# toml++ is not among Spack's own packages.
from spack.package import *


class Tomlplusplus(CMakePackage):
    """Reads and writes TOML, for C++17 and later."""

    homepage = "https://marzer.github.io/tomlplusplus"
    git = "https://github.com/marzer/tomlplusplus.git"

    license("MIT")

    version("3.4.0", tag="v3.4.0")
    version("3.3.0", tag="v3.3.0")

    depends_on("cxx", type="build")
