#pragma once

#include <cstdint>
#include <string_view>

namespace lore {

/// Instruction sets that kernels are compiled for; one source file, compiled once per set (cmake: lore_kernel).
///
/// baseline: x86-64 with SSE2, or whatever another processor offers; v3: AVX2; v4: AVX-512. Results are equal to the
/// bit, so the choice is one of speed alone.
enum class Isa : std::uint8_t { baseline, v3, v4 };

std::string_view name(Isa);
/// The best set that both this build and this processor know.
Isa detected_isa();
/// The set in use: LORE_ISA=baseline|v3|v4 from the environment if given, else the detected one. Throws UsageError for
/// another word, or a set that this processor lacks.
Isa active_isa();
/// For tests: overrides active_isa() in this process.
void use_isa(Isa);
/// Floats in a native vector: 4, 8, 16.
constexpr int lanes_of(Isa isa) { return isa == Isa::v4 ? 16 : isa == Isa::v3 ? 8 : 4; }

}   // namespace lore
