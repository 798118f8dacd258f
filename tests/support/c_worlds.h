#pragma once

#include <lore/world/library.h>

#include <memory>
#include <string>

namespace lore::test {

/// A library of tests/support/worlds, compiled with the tests.
inline std::string c_world(std::string const& name) { return std::string{LORE_BINARY_DIR} + "/worlds/" + name + ".so"; }

/// The world of trial.c that breaks one rule, or with "" none.
inline std::unique_ptr<World> trial_world(std::string const& fault = "") {
    return load_world(c_world("trial"), fault.empty() ? "" : "fault = \"" + fault + "\"\n");
}

}   // namespace lore::test
