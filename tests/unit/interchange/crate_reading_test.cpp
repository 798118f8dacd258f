#include <interchange/crate_reading.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

std::string crate_with(std::string const& entities) {
    return R"({"@graph": [
        {"@id": "ro-crate-metadata.json", "about": {"@id": "./"}, "conformsTo": {"@id": "https://w3id.org/ro/crate/1.2"}},
        {"@id": "./", "@type": "Dataset", "name": "N", "description": "D", "datePublished": "2026-01-31", "license": "L"})" +
           entities + "]}";
}

}   // namespace

TEST(CrateReading, finds_the_files_that_are_there_and_those_left_out) {
    CrateDescription const crate = read_crate(crate_with(R"(,
        {"@id": "a%20b/c.csv", "@type": "File", "contentSize": "7", "sha256": "00ff"},
        {"@id": "d", "@type": ["File", "Other"], "contentSize": 8},
        {"@id": "#left-out/e", "@type": "File", "localPath": "e", "contentSize": "9"},
        {"@id": "https://example.org/f", "@type": "File"},
        {"@id": "#g", "@type": "File"},
        {"@id": "h", "@type": "Dataset"})"));
    EXPECT_THAT(crate.defects, IsEmpty());
    EXPECT_EQ(crate.title, "N");
    ASSERT_EQ(crate.files.size(), 2u);
    EXPECT_EQ(crate.files[0].path, "a b/c.csv");
    EXPECT_EQ(crate.files[0].bytes, 7u);
    EXPECT_EQ(crate.files[0].sha256, "00ff");
    EXPECT_EQ(crate.files[1].bytes, 8u);
    ASSERT_EQ(crate.left_out.size(), 1u);
    EXPECT_EQ(crate.left_out[0].path, "e");
}

TEST(CrateReading, takes_no_list_for_a_length_however_deep) {
    std::string const deep = std::string(200'000, '[') + std::string(200'000, ']');
    CrateDescription const crate =
        read_crate(crate_with(R"(, {"@id": "a", "@type": "File", "contentSize": )" + deep + "}"));
    ASSERT_EQ(crate.files.size(), 1u);
    EXPECT_FALSE(crate.files[0].bytes);
}

TEST(CrateReading, tells_each_path_that_leads_out_of_it) {
    CrateDescription const crate = read_crate(crate_with(R"(,
        {"@id": "../a", "@type": "File"}, {"@id": "%2e%2e/b", "@type": "File"}, {"@id": "/c", "@type": "File"},
        {"@id": "d%", "@type": "File"}, {"@id": "#x", "@type": "File", "localPath": "../e"})"));
    EXPECT_THAT(crate.files, IsEmpty());
    EXPECT_THAT(crate.left_out, IsEmpty());
    EXPECT_THAT(crate.defects, ElementsAre(HasSubstr("../a"), HasSubstr("%2e%2e/b"), HasSubstr("/c"), HasSubstr("d%"),
                                           HasSubstr("#x")));
}

TEST(CrateReading, tells_what_a_crate_lacks) {
    EXPECT_THAT(read_crate("{").defects, ElementsAre(HasSubstr("no JSON document")));
    EXPECT_THAT(read_crate("[]").defects, ElementsAre(HasSubstr("no JSON document")));
    EXPECT_THAT(read_crate(R"({"@graph": [1, {}]})").defects, ElementsAre(HasSubstr("describes no root")));
    auto const defects = read_crate(R"({"@graph": [{"@id": "ro-crate-metadata.json", "about": {"@id": "./"}},
                                                   {"@id": "./", "@type": "Dataset", "name": "N"}]})")
                             .defects;
    EXPECT_THAT(defects, ElementsAre(HasSubstr("RO-Crate 1"), HasSubstr("'description'"), HasSubstr("'datePublished'"),
                                     HasSubstr("'license'")));
}
