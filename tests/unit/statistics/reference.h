#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace lore::test {

/// A line of reference.txt: what SciPy and NumPy say about two samples (make_reference.py).
struct ReferenceCase {
    double u = 0, p = 0;
    bool exact = false;
    double lower_quartile = 0, median = 0, upper_quartile = 0;
    std::vector<double> first, second;
};

inline std::vector<ReferenceCase> reference_cases() {
    std::ifstream file{LORE_SOURCE_DIR "/tests/unit/statistics/reference.txt"};
    std::vector<ReferenceCase> cases;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("#")) continue;
        std::istringstream fields{line};
        ReferenceCase reference;
        std::string method, word;
        fields >> reference.u >> reference.p >> method >> reference.lower_quartile >> reference.median >>
            reference.upper_quartile >> word;
        reference.exact = method == "exact";
        while (fields >> word && word != "|") reference.first.push_back(std::stod(word));
        while (fields >> word) reference.second.push_back(std::stod(word));
        cases.push_back(reference);
    }
    return cases;
}

}   // namespace lore::test
