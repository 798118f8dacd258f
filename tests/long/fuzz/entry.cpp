#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    read_input({reinterpret_cast<std::byte const*>(data), size});
    return 0;
}
