#include <lore/core/isa.h>

#include <lore/core/names.h>

#include <atomic>
#include <cstdlib>
#include <string>

namespace lore {

namespace {

constexpr auto isa_names = names_for<Isa>("baseline", "v3", "v4");
std::atomic<int> chosen{-1};

Isa from_environment() {
    char const* const wish = std::getenv("LORE_ISA");
    if (wish == nullptr || *wish == '\0') return detected_isa();
    constexpr std::string_view remedy = "Unset LORE_ISA to take the best set.";
    auto const isa = isa_names.find(wish);
    if (!isa)
        throw UsageError("LORE_ISA=" + std::string{wish} + " is not an instruction set",
                         "known are " + isa_names.list(), remedy);
    if (*isa > detected_isa())
        throw UsageError("LORE_ISA=" + std::string{wish} + " cannot be used",
                         "this processor or build has no more than " + std::string{name(detected_isa())}, remedy);
    return *isa;
}

}   // namespace

std::string_view name(Isa isa) { return isa_names[isa]; }

Isa detected_isa() {
    if constexpr (LORE_ISA_COUNT == 1) return Isa::baseline;
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return Isa::v4;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma"))
        return Isa::v3;
#endif
    return Isa::baseline;
}

Isa active_isa() {
    int const known = chosen.load(std::memory_order_relaxed);
    if (known >= 0) return static_cast<Isa>(known);
    Isa const isa = from_environment();
    chosen.store(static_cast<int>(isa), std::memory_order_relaxed);
    return isa;
}

void use_isa(Isa isa) { chosen.store(static_cast<int>(isa), std::memory_order_relaxed); }

}   // namespace lore
