#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lore {

/// A group of ranks that talk to each other, or one process alone. Cheap to copy; MPI stays behind it.
class Communicator {
public:
    /// This process alone, without MPI.
    Communicator();
    int rank() const;
    int size() const;

    // Collective: every rank calls them in the same order.
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
    /// Throws UsageError where srun without a matching PMI has started independent processes that each think they are
    /// alone.
    Session(int& argc, char**& argv);
    /// Finalises: every rank must come here, so nobody may leave by an exception that others do not share (abort).
    ~Session();
    Session(Session const&) = delete;
    Session& operator=(Session const&) = delete;

    Communicator const& world() const { return world_; }
    int rank() const { return world_.rank(); }
    int size() const { return world_.size(); }
    /// Ends all ranks at once, wherever they are.
    [[noreturn]] void abort(int exit_code) const;

private:
    Communicator world_;
    bool launched_ = false;
};

/// Name of the machine that this rank runs on.
std::string host_name();

}   // namespace lore
