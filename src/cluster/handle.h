#pragma once

#include <lore/cluster/session.h>

#include <mpi.h>

namespace lore {

struct Communicator::Handle {
    MPI_Comm comm = MPI_COMM_NULL;   ///< null for a process alone
    int rank = 0;
    int size = 1;
    ~Handle();
};

}   // namespace lore
