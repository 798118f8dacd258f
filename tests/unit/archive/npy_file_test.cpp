#include <lore/archive/npy_file.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

/// A file with this dictionary and these values, as numpy.save lays it out.
template <class T>
std::string npy(std::string const& dictionary, std::vector<T> const& values) {
    std::string header = dictionary;
    header.append((64 - (10 + header.size() + 1) % 64) % 64, ' ');
    header += '\n';
    std::string file = "\x93NUMPY";
    file += {'\x01', '\x00', static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
    file += header;
    file.append(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T));
    return file;
}

std::string refusal(Scratch const& scratch, std::string const& content) {
    std::ofstream{scratch.file("x.npy"), std::ios::binary} << content;
    return test::complaint_of([&] { read_npy(scratch.file("x.npy")); });
}

}   // namespace

TEST(Npy, gives_back_what_was_written) {
    Scratch const scratch;
    std::vector<float> const values{0, 0.25f, -1.5f, 3e-8f, 1, 2};
    write_npy(scratch.file("a.npy"), values, std::array<std::size_t, 3>{1, 2, 3});
    NpyArray const array = read_npy(scratch.file("a.npy"));
    EXPECT_THAT(array.shape, ElementsAre(1, 2, 3));
    EXPECT_EQ(array.values, values);
    write_npy(scratch.file("b.npy"), std::vector<double>{0.5, 4}, std::array<std::size_t, 1>{2});
    EXPECT_THAT(read_npy(scratch.file("b.npy")).values, ElementsAre(0.5f, 4.0f));
    EXPECT_THAT(read_npy(scratch.file("b.npy")).shape, ElementsAre(2));
}

TEST(Npy, begins_its_data_at_a_multiple_of_64_bytes_for_any_shape) {
    Scratch const scratch;
    for (std::size_t size : {0u, 1u, 10u, 1000u, 123456u}) {
        write_npy(scratch.file("a.npy"), std::vector<float>(size), std::array<std::size_t, 2>{size, 1});
        EXPECT_EQ((read_file(scratch.file("a.npy")).size() - size * sizeof(float)) % 64, 0u);
        EXPECT_THAT(read_npy(scratch.file("a.npy")).shape, ElementsAre(size, 1));
    }
}

TEST(Npy, reads_what_numpy_writes) {
    Scratch const scratch;
    EXPECT_EQ(refusal(scratch, npy<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }", {0, 1, 2, 3})),
              "");
    EXPECT_EQ(refusal(scratch, npy<float>("{\"shape\":(1,),\"fortran_order\":False,\"descr\":\"<f4\"}", {7})), "");
    EXPECT_EQ(refusal(scratch, npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (), }", {7})), "");
    EXPECT_EQ(refusal(scratch, npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 5), }", {})), "");
}

TEST(Npy, refuses_what_it_cannot_take) {
    Scratch const scratch;
    auto const good = std::string{"{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }"};
    EXPECT_THAT(refusal(scratch, "window,step\n"), HasSubstr("not an NPY file"));
    EXPECT_THAT(refusal(scratch, npy<int>("{'descr': '<i4', 'fortran_order': False, 'shape': (2,), }", {1, 2})),
                HasSubstr("<i4"));
    EXPECT_THAT(refusal(scratch, npy<float>("{'descr': '>f4', 'fortran_order': False, 'shape': (2,), }", {1, 2})),
                HasSubstr(">f4"));
    EXPECT_THAT(refusal(scratch, npy<float>("{'descr': '<f4', 'fortran_order': True, 'shape': (2,), }", {1, 2})),
                HasSubstr("Fortran"));
    EXPECT_THAT(refusal(scratch, npy<float>("{'descr': '<f4', 'shape': (2,), }", {1, 2})), HasSubstr("header"));
    EXPECT_THAT(refusal(scratch, npy<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (-2,), }", {1, 2})),
                HasSubstr("header"));
    EXPECT_THAT(refusal(scratch, npy<float>(good, {1, 2, 3})), HasSubstr("needs 8"));
    EXPECT_THAT(
        refusal(scratch,
                npy<float>(
                    "{'descr': '<f4', 'fortran_order': False, 'shape': (4611686018427387904, 4611686018427387904), }",
                    {1})),
        HasSubstr("cut"));
    EXPECT_THAT(refusal(scratch, npy<float>(good, {1, std::numeric_limits<float>::quiet_NaN()})),
                HasSubstr("not finite"));
    EXPECT_THAT(refusal(scratch, npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }", {1e300})),
                HasSubstr("not finite"));
}

TEST(Npy, detects_truncation_at_every_length) {
    Scratch const scratch;
    std::string const whole = npy<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }", {1, 2});
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(refusal(scratch, whole.substr(0, length)), "") << length;
}
