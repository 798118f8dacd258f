#include <lore/core/isa.h>

#include <gtest/gtest.h>

using namespace lore;

namespace {

namespace isa_baseline {
int lanes() { return 4; }
}   // namespace isa_baseline
namespace isa_v3 {
int lanes() { return 8; }
}   // namespace isa_v3
namespace isa_v4 {
int lanes() { return 16; }
}   // namespace isa_v4

}   // namespace

TEST(KernelFor, is_the_function_of_that_instruction_set) {
    for (Isa isa : {Isa::baseline, Isa::v3, Isa::v4})
        EXPECT_EQ(kernel_for(isa, isa_baseline::lanes, isa_v3::lanes, isa_v4::lanes)(), lanes_of(isa));
}

TEST(KernelFor, is_the_baseline_in_a_build_of_fewer_sets) {
    EXPECT_EQ(kernel_for(Isa::v4, isa_baseline::lanes)(), 4);
    EXPECT_EQ(kernel_for(Isa::v4, isa_baseline::lanes, isa_v3::lanes)(), 4);
}
