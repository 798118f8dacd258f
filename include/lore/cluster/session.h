#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace lore {

/// A group of ranks that exchange messages, or one process without MPI. Cheap to copy; hides MPI. Of no use once the
/// Session has ended.
class Communicator {
public:
    /// This process alone, without MPI.
    Communicator();
    int rank() const;
    int size() const;

    // Collective: every rank calls them in the same order. At most 2 GiB in all; an MPI error ends the program.

    /// Rank 0's bytes on every rank; what other ranks pass is ignored.
    std::vector<std::byte> broadcast(std::vector<std::byte> from_rank_0) const;
    /// Every rank's text, in order of rank, on rank 0; empty elsewhere.
    std::vector<std::string> gather(std::string const& text) const;

    struct Handle;
    explicit Communicator(std::shared_ptr<Handle const> handle);
    Handle const& handle() const { return *handle_; }

private:
    std::shared_ptr<Handle const> handle_;
};

/// MPI from the program's start to its end. A process that no launcher has started runs alone and never touches MPI.
class Session {
public:
    /// Throws UsageError if a launcher of another MPI, or srun without a matching PMI, has started several independent
    /// processes, each of which would run alone; not of a command line that only asks (--help, -h, --version).
    Session(int& argc, char**& argv);
    /// Finalizes MPI, which waits for all ranks: a rank that fails alone must call abort() instead of leaving by an
    /// exception.
    ~Session();
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    Communicator const& world() const { return world_; }
    int rank() const { return world_.rank(); }
    int size() const { return world_.size(); }
    /// Ends all ranks at once with this exit code, whatever they do; writes out the standard streams first.
    [[noreturn]] void abort(int exit_code) const;

private:
    Communicator world_;
    bool launched_ = false;
};

/// Whether a rank that waits for messages sleeps at once (LORE_WAITING=sleep), leaving its processor to others, instead
/// of looking for them first. Throws UsageError if the variable says something else than poll or sleep.
bool sleeps_while_waiting();

/// The MPI that Lore was built with, such as {"Open MPI", "4.1.4"} or {"MPICH", "4.0.2"}; {"MPI", its standard} for
/// others.
struct MpiLibrary {
    std::string name, version;
};
MpiLibrary mpi_library();

/// Name of the machine that this rank runs on.
std::string host_name();

}   // namespace lore
