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

/// LORE_KERNEL(EditKernel edit()) declares a function of a kernel source, one for each instruction set, in the
/// namespace where it stands; kernel_for(isa, LORE_KERNELS(edit)) is the one for that set.
#define LORE_KERNEL(...)                                                                                               \
    namespace isa_baseline {                                                                                           \
    __VA_ARGS__;                                                                                                       \
    }                                                                                                                  \
    namespace isa_v3 {                                                                                                 \
    __VA_ARGS__;                                                                                                       \
    }                                                                                                                  \
    namespace isa_v4 {                                                                                                 \
    __VA_ARGS__;                                                                                                       \
    }
#if LORE_ISA_COUNT > 1
#define LORE_KERNELS(function) isa_baseline::function, isa_v3::function, isa_v4::function
#else
#define LORE_KERNELS(function) isa_baseline::function
#endif

/// Sets that this build lacks fall back to the baseline.
template <class Function>
Function* kernel_for(Isa isa, Function* baseline, Function* v3 = nullptr, Function* v4 = nullptr) {
    Function* const compiled[]{baseline, v3, v4};
    Function* const wanted = compiled[static_cast<int>(isa)];
    return wanted != nullptr ? wanted : baseline;
}

}   // namespace lore
