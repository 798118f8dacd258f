#include <lore/interchange/verify_pack.h>

#include <interchange/archive_file.h>
#include <interchange/crate.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

/// Packs of files of a few letters, made by hand.
class VerifyPack : public ::testing::Test {
protected:
    using Files = std::vector<std::pair<std::string, std::string>>;

    static std::string crate_of(Files const& files) {
        Json graph = Json::array();
        graph.push_back({{"@id", "ro-crate-metadata.json"},
                         {"about", reference_to("./")},
                         {"conformsTo", reference_to("https://w3id.org/ro/crate/1.2")}});
        graph.push_back({{"@id", "./"},
                         {"@type", "Dataset"},
                         {"name", "N"},
                         {"description", "D"},
                         {"datePublished", "2026-01-31"},
                         {"license", "L"}});
        for (auto const& [path, text] : files)
            graph.push_back({{"@id", entity_id(path)},
                             {"@type", "File"},
                             {"contentSize", std::to_string(text.size())},
                             {"sha256", sha256_of(text)}});
        return Json{{"@graph", graph}}.dump();
    }
    void write_archive(std::string const& name, Files const& files) const {
        ArchiveWriter archive{scratch.file(name)};
        for (auto const& [path, text] : files) {
            archive.begin(path, text.size());
            archive.write(std::as_bytes(std::span{text.data(), text.size()}));
        }
        archive.close();
    }
    std::vector<std::string> defects_of(std::string const& name) const {
        return verify_pack(scratch.file(name)).defects;
    }

    Files const files{{"a.txt", "first"}, {"b c/d.txt", "second"}};
    Scratch scratch;
};

TEST_F(VerifyPack, finds_nothing_wrong_with_what_is_as_it_is_described) {
    for (char const* name : {"p.tar.zst", "p.tar.gz", "p.zip"}) {
        Files all = files;
        all.emplace_back("ro-crate-metadata.json", crate_of(files));
        write_archive(name, all);
        EXPECT_THAT(defects_of(name), IsEmpty()) << name;
        EXPECT_EQ(verify_pack(scratch.file(name)).title, "N");
    }
}

TEST_F(VerifyPack, takes_a_crate_that_lies_in_a_folder_of_its_archive) {
    write_archive(
        "p.zip",
        {{"top/a.txt", "first"}, {"top/b c/d.txt", "second"}, {"top/ro-crate-metadata.json", crate_of(files)}});
    EXPECT_THAT(defects_of("p.zip"), IsEmpty());
    write_archive("q.zip", {{"top/a.txt", "first"},
                            {"beside.txt", "?"},
                            {"top/b c/d.txt", "second"},
                            {"top/ro-crate-metadata.json", crate_of(files)}});
    EXPECT_THAT(defects_of("q.zip"), ElementsAre("beside.txt: it lies outside of the crate"));
}

TEST_F(VerifyPack, tells_what_is_missing_changed_and_too_much) {
    write_archive("p.zip", {{"a.txt", "First"}, {"extra.txt", ""}, {"ro-crate-metadata.json", crate_of(files)}});
    EXPECT_THAT(defects_of("p.zip"), ElementsAre("a.txt: its checksum is not the one described",
                                                 "b c/d.txt: it is missing", "extra.txt: it is not described"));
    write_archive("q.zip", {{"a.txt", "firs"}, files[1], {"ro-crate-metadata.json", crate_of(files)}});
    EXPECT_THAT(defects_of("q.zip"), ElementsAre("a.txt: it has 4 bytes, not 5"));
    write_archive("r.zip", files);
    EXPECT_THAT(defects_of("r.zip"), ElementsAre("ro-crate-metadata.json: it is missing, and so nothing is described"));
}

TEST_F(VerifyPack, does_not_follow_names_that_lead_out) {
    write_archive("p.zip", {{"../out.txt", "x"},
                            {"/tmp/lore-out.txt", "x"},
                            files[0],
                            files[1],
                            {"ro-crate-metadata.json", crate_of(files)}});
    EXPECT_THAT(defects_of("p.zip"), ElementsAre("../out.txt: its name is no path in the archive",
                                                 "/tmp/lore-out.txt: its name is no path in the archive"));
}

TEST_F(VerifyPack, tells_of_a_path_that_two_entries_have_and_reads_the_other_files) {
    Files const described{
        {"a.csv", "a,b\n1,2\n"}, {"c.csv/d.csv", "a,b\n1,2\n"}, {"c.csv", "a\n1\n"}, {"runs/cut.csv", "a\n1"}};
    Files all = described;
    all.emplace_back("a.csv", "a,b\n3,4\n");
    all.emplace_back("ro-crate-metadata.json", crate_of(described));
    write_archive("p.zip", all);
    EXPECT_THAT(defects_of("p.zip"),
                ElementsAre("a.csv: it is there twice", "c.csv: it is a file and a folder",
                            "runs/cut.csv: cannot read runs/cut.csv (its last line was cut). Take a copy that is "
                            "whole."));
}

TEST_F(VerifyPack, reads_the_files_of_lore) {
    Files const of_lore{{"final.csv", "a,b\n1,2\n3"},
                        {"notes.csv", "of its author, without a last line end"},
                        {"runs.csv", "a,b\n1,2\n"},
                        {"x.lore", "no container"}};
    Files all = of_lore;
    all.emplace_back("ro-crate-metadata.json", crate_of(of_lore));
    write_archive("p.zip", all);
    auto const defects = defects_of("p.zip");
    ASSERT_EQ(defects.size(), 2u);
    EXPECT_EQ(defects[0], "final.csv: cannot read final.csv (its last line was cut). Take a copy that is whole.");
    EXPECT_THAT(defects[1], HasSubstr("x.lore: "));
}

TEST_F(VerifyPack, compares_the_sums_that_other_programs_read_with_the_crate) {
    Files described = files;
    std::string const crate = crate_of(files);
    auto const line = [](std::string const& path, std::string const& text) {
        return sha256_of(text) + "  " + path + "\n";
    };
    std::string const good =
        line("a.txt", "first") + line("b c/d.txt", "second") + line("ro-crate-metadata.json", crate);
    auto const defects = [&](std::string const& sums) {
        // Without its own line in the crate it is one file too many.
        write_archive("p.zip", {files[0], files[1], {"SHA256SUMS", sums}, {"ro-crate-metadata.json", crate}});
        auto found = defects_of("p.zip");
        fs::remove(scratch.file("p.zip"));
        EXPECT_EQ(found.front(), "SHA256SUMS: it is not described");
        found.erase(found.begin());
        return found;
    };
    EXPECT_THAT(defects(good), IsEmpty());
    EXPECT_THAT(defects(line("a.txt", "first") + line("b c/d.txt", "second")),
                ElementsAre("SHA256SUMS: it has no line for ro-crate-metadata.json"));
    EXPECT_THAT(defects(good + "nonsense\n"), ElementsAre("SHA256SUMS: line 4 is of no file that is described"));
    EXPECT_THAT(defects(line("a.txt", "other") + good.substr(good.find('\n') + 1)),
                ElementsAre("SHA256SUMS: its checksum of a.txt is another"));
}

TEST_F(VerifyPack, refuses_archives_that_are_none_or_cut) {
    std::ofstream{scratch.file("p.zip")} << "no archive";
    EXPECT_THAT(test::complaint_of([&] { defects_of("p.zip"); }), HasSubstr("cannot read " + scratch.file("p.zip")));
    EXPECT_THAT(test::complaint_of<UsageError>([&] { defects_of("missing.zip"); }), HasSubstr("missing.zip"));
    Files all = files;
    all.emplace_back("ro-crate-metadata.json", crate_of(files));
    write_archive("whole.tar.zst", all);
    fs::resize_file(scratch.file("whole.tar.zst"), fs::file_size(scratch.file("whole.tar.zst")) / 2);
    EXPECT_THAT(test::complaint_of([&] { defects_of("whole.tar.zst"); }), HasSubstr("cannot read"));
}

TEST_F(VerifyPack, never_writes_over_an_archive_or_leaves_half_of_one) {
    write_archive("p.zip", files);
    EXPECT_THAT(test::complaint_of<UsageError>([&] { write_archive("p.zip", files); }), HasSubstr("it exists"));
    EXPECT_THAT(test::complaint_of<UsageError>([&] { write_archive("p.rar", files); }), HasSubstr(".tar.zst"));
    {
        ArchiveWriter unfinished{scratch.file("q.zip")};
        unfinished.begin("a.txt", 5);
    }
    {
        ArchiveWriter late{scratch.file("r.zip")};
        std::ofstream{scratch.file("r.zip")} << "somebody's";
        EXPECT_THAT(test::complaint_of([&] { late.close(); }), HasSubstr("File exists"));
    }
    std::vector<std::string> names;
    for (auto const& entry : fs::directory_iterator{scratch.path()}) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    EXPECT_THAT(names, ElementsAre("p.zip", "r.zip"));
    EXPECT_EQ(fs::file_size(scratch.file("r.zip")), 10u);
}
