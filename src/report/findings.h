#pragma once

#include "comparison.h"
#include "matrix.h"
#include "task_parts.h"

#include <vector>

namespace lore {

/// What the results say, worked out once for tables, figures and page.
struct Findings {
    std::vector<Comparison> comparisons;   ///< compare_treatments
    std::vector<Comparison> planned;       ///< compare_pools
    std::vector<MatrixField> matrix;       ///< transfer_matrix
    std::vector<TaskPart> parts;           ///< task_parts
};
Findings findings_of(CampaignPlan const&, Results const&);

}   // namespace lore
