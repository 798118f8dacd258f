#pragma once

#include "results.h"

#include <lore/statistics/bootstrap.h>

#include <string>
#include <vector>

namespace lore {

/// What knowledge of a source task gives on a target task, over none: a row of matrix.csv, a field of the figure.
/// Rewards are those of the best-of-runs at the last generation [unit of the target task].
struct MatrixField {
    TransferPair pair;
    std::string why;   ///< why there are no numbers; empty: there are
    std::string unit;
    int generation = 0;   ///< the last of the runs without knowledge
    int n = 0, n_none = 0;
    double mean = 0, mean_none = 0;
    double difference = 0;      ///< mean - mean_none
    Interval difference_band;   ///< 95 % percentile bootstrap
    double a12 = 0.5;           ///< probability that a run with knowledge beats one without
    Interval a12_band;          ///< 95 % percentile bootstrap
    double p = 1, p_holm = 1;   ///< two-sided Mann-Whitney; Holm's correction over all fields with numbers
};

/// Row by row, in the order of the campaign's file; empty where it has no [transfer].
std::vector<MatrixField> transfer_matrix(CampaignPlan const&, Results const&);
/// matrix.csv: the numbers of a field without them are empty.
std::string matrix_csv(std::vector<MatrixField> const&);

/// The campaign without the treatments that a former report knew not to fit. The campaign's file alone does not say
/// that where a world cannot be opened.
CampaignPlan without_misfits(CampaignPlan, Results const&);

std::string difference_text(MatrixField const&);        ///< "+1.25"
std::string difference_band_text(MatrixField const&);   ///< "+0.31 .. +2.19", with as many decimals
/// "10", or "9 to 10" where the fields differ: how many runs one has, by this member.
std::string count_text(std::vector<MatrixField> const&, int MatrixField::*);

/// The matrix as an SVG document: rows are source tasks, columns target tasks, fields colored by A12.
std::string draw_matrix(CampaignPlan const&, std::vector<MatrixField> const&);

}   // namespace lore
