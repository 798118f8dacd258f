#include <lore/cluster/session.h>

#include "handle.h"

#include <lore/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace lore {

namespace {

/// Set by mpirun, mpiexec and srun --mpi=... for the processes that they start.
bool started_by_a_launcher() {
    constexpr char const* marks[]{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"};
    return std::any_of(std::begin(marks), std::end(marks),
                       [](char const* mark) { return std::getenv(mark) != nullptr; });
}

int number_in_environment(char const* name) {
    char const* const text = std::getenv(name);
    return text == nullptr ? 0 : std::atoi(text);
}

/// Whether a command line asks for help or for the version: that may be typed wherever one is, also in an allocation.
bool only_asks(int argc, char** argv) {
    return std::any_of(argv, argv + argc,
                       [](std::string_view word) { return word == "--help" || word == "-h" || word == "--version"; });
}

/// A launcher of another MPI, or srun without a matching PMI, starts as many runs as there are processes, all writing
/// to one directory.
void refuse_accidental_copies() {
    for (char const* const size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        int const started = number_in_environment(size);
        if (started == 1) return;
        if (started > 1)
            throw UsageError("this process is alone",
                             fmt::format("its launcher started {}, but they do not find each other; lore-evolve was "
                                         "built with {} {}",
                                         started, mpi_library().name, mpi_library().version),
                             "Start it with the mpirun of that MPI, or with 'srun --mpi=pmix'.");
    }
    int const step = number_in_environment("SLURM_STEP_NUM_TASKS");
    int const tasks = step > 0 ? step : number_in_environment("SLURM_NTASKS");
    if (tasks > 1)
        throw UsageError("this process is alone",
                         fmt::format("Slurm gave {} tasks, but they do not find each other", tasks),
                         "Start it with 'mpirun', or with 'srun --mpi=pmix'.");
}

}   // namespace

Communicator::Handle::~Handle() {
    int finalized = 0;
    if (comm == MPI_COMM_NULL) return;
    MPI_Finalized(&finalized);
    if (!finalized) MPI_Comm_free(&comm);
}

Communicator::Communicator() : handle_(std::make_shared<Handle>()) {}
Communicator::Communicator(std::shared_ptr<Handle const> handle) : handle_(std::move(handle)) {}
int Communicator::rank() const { return handle_->rank; }
int Communicator::size() const { return handle_->size; }

std::vector<std::byte> Communicator::broadcast(std::vector<std::byte> from_rank_0) const {
    if (size() == 1) return from_rank_0;
    unsigned long long length = from_rank_0.size();
    MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, handle_->comm);
    from_rank_0.resize(length);
    MPI_Bcast(from_rank_0.data(), static_cast<int>(length), MPI_BYTE, 0, handle_->comm);
    return from_rank_0;
}

std::vector<std::string> Communicator::gather(std::string const& text) const {
    if (size() == 1) return {text};
    int const length = static_cast<int>(text.size());
    bool const root = rank() == 0;
    std::vector<int> lengths(root ? static_cast<std::size_t>(size()) : 0), starts;
    MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, handle_->comm);
    int total = 0;
    for (int const one : lengths) {
        starts.push_back(total);
        total += one;
    }
    std::string all(static_cast<std::size_t>(total), '\0');
    MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), starts.data(), MPI_CHAR, 0, handle_->comm);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < lengths.size(); ++i)
        texts.push_back(all.substr(static_cast<std::size_t>(starts[i]), static_cast<std::size_t>(lengths[i])));
    return texts;
}

Session::Session(int& argc, char**& argv) {
    if (!started_by_a_launcher()) {
        if (!only_asks(argc, argv)) refuse_accidental_copies();
        return;
    }
    int granted = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &granted);
    launched_ = true;
    auto handle = std::make_shared<Communicator::Handle>();
    MPI_Comm_dup(MPI_COMM_WORLD, &handle->comm);
    MPI_Comm_rank(handle->comm, &handle->rank);
    MPI_Comm_size(handle->comm, &handle->size);
    world_ = Communicator{std::move(handle)};
    if (size() == 1) {
        try {
            refuse_accidental_copies();
        } catch (UsageError const&) {
            world_ = Communicator{};
            MPI_Finalize();
            throw;
        }
    }
}

Session::~Session() {
    world_ = Communicator{};
    if (launched_) MPI_Finalize();
}

void Session::abort(int exit_code) const {
    std::fflush(nullptr);
    if (launched_ && size() > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
}

bool sleeps_while_waiting() {
    char const* const wish = std::getenv("LORE_WAITING");
    if (wish == nullptr || *wish == '\0' || std::string_view{wish} == "poll") return false;
    if (std::string_view{wish} == "sleep") return true;
    throw UsageError(fmt::format("LORE_WAITING={} is not a way of waiting", wish), "known are poll, sleep",
                     "Unset LORE_WAITING to look for messages first.");
}

MpiLibrary mpi_library() {
#if defined(OMPI_MAJOR_VERSION)
    return {"Open MPI", fmt::format("{}.{}.{}", OMPI_MAJOR_VERSION, OMPI_MINOR_VERSION, OMPI_RELEASE_VERSION)};
#elif defined(MPICH_VERSION)
    return {"MPICH", MPICH_VERSION};
#else
    return {"MPI", fmt::format("{}.{}", MPI_VERSION, MPI_SUBVERSION)};
#endif
}

std::string host_name() {
    char name[256] = "";
    if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
    return name;
}

}   // namespace lore
