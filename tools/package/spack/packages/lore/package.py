# From a clone of Lore:
#
#   spack repo add tools/package/spack
#   spack dev-build -d . lore@1.0.0                # with Open MPI
#   spack dev-build -d . lore@1.0.0 mpi=mpich
from spack.package import *


class Lore(CMakePackage):
    """Evolves controllers of a simulated robot, and hands knowledge from one task to the next."""


    version("1.0.0")

    variant("mpi", default="openmpi", values=("openmpi", "mpich"), multi=False, description="MPI of lore-evolve")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("help2man", type="build")
    depends_on("openmpi", when="mpi=openmpi")
    depends_on("mpich", when="mpi=mpich")
    depends_on("boost@1.74: +serialization")
    depends_on("flann@1.9:")
    depends_on("lz4")
    depends_on("cli11@2.1:")
    depends_on("tomlplusplus@3.3:")
    depends_on("nlohmann-json@3.11:")
    depends_on("fmt@9:")
    depends_on("random123")
    depends_on("zstd")
    depends_on("xxhash")
    depends_on("zlib")
    depends_on("librsvg")
    depends_on("libmicrohttpd")
    depends_on("libarchive")
    depends_on("nettle")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("LORE_BUILD_TESTS", False),
            self.define("LORE_BUILD_BENCHMARKS", False),
            self.define("MPI_CXX_COMPILER", self.spec["mpi"].mpicxx),
        ]

    @run_after("build")
    def manual_pages(self):
        with working_dir(self.build_directory):
            ninja("manual-pages")

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        Executable(join_path(self.prefix.bin, "lore-evolve"))("--bench")
