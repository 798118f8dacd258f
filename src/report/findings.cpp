#include "findings.h"

namespace lore {

Findings findings_of(CampaignPlan const& plan, Results const& results) {
    Findings findings{
        compare_treatments(plan, results), compare_pools(plan, results), transfer_matrix(plan, results), {}};
    findings.parts = task_parts(plan, results, findings.comparisons);
    return findings;
}

}   // namespace lore
