#include <interchange/inventory.h>

#include "campaign/campaign_fixture.h"
#include "support/complaint.h"

#include <gmock/gmock.h>

#include <sys/stat.h>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

namespace fs = std::filesystem;

TEST(SafePath, leads_nowhere_but_down) {
    for (char const* good : {"a", "a/b.csv", "runs/kb1/001/manifest.json", "...", "a b", "100%", "\xc3\xa9t\xc3\xa9"})
        EXPECT_TRUE(is_safe_path(good)) << good;
    for (char const* bad : {"",       "/",    "/etc/passwd", ".",         "..",           "../a",        "a/..",
                            "a/../b", "a//b", "a/",          "./a",       "a/./b",        "a\nb",        "a\x7f",
                            "a\xff",  "\xc3", "a\x1b[2J",    "a\xc2\x9b", "\xe0\x80\x80", "\xed\xa0\x80"})
        EXPECT_FALSE(is_safe_path(bad)) << bad;
    EXPECT_FALSE(is_safe_path(std::string_view{"a\0b", 3}));
}

TEST(Transient, are_locks_and_temporary_files) {
    for (char const* path : {"runs/kb1/001/lock", "steps/kb1-001.lock", "final.csv.lore-tmp-123"})
        EXPECT_TRUE(is_transient(path)) << path;
    for (char const* path : {"runs/kb1/001/clock", "steps/kb1-001.json", "notes.lock"})
        EXPECT_FALSE(is_transient(path)) << path;
}

class InventoryTest : public test::CampaignTest {
protected:
    void put(std::string const& path, std::string const& text) const {
        fs::create_directories(fs::path{scratch.file(path)}.parent_path());
        write(path, text);
    }
    static std::vector<std::string> paths(std::vector<PackedFile> const& files) {
        std::vector<std::string> all;
        for (PackedFile const& file : files) all.push_back(file.path);
        return all;
    }
    Inventory inventory(std::vector<PackPart> const& leave_out = {}) const {
        return take_inventory(plan(), directory(), leave_out, [] {});
    }
};

TEST_F(InventoryTest, has_all_files_of_the_campaign_and_what_it_is_made_from) {
    put("c/runs/kb1/001/all.lore", "everybody");
    put("c/runs/kb1/001/lock", "");
    put("c/steps/kb1-001.lock", "");
    put("c/notes.txt", "abc");
    put("c/inputs/former.toml", "of a former description");
    put("c/SHA256SUMS", "likewise");
    Inventory const all = inventory();
    EXPECT_THAT(paths(all.files), ElementsAre("inputs/campaign.toml", "inputs/source.toml", "inputs/target.toml",
                                              "notes.txt", "runs/kb1/001/all.lore"));
    EXPECT_EQ(all.files[3].bytes, 3u);
    EXPECT_EQ(all.files[3].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sums_text({all.files[3]}),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  notes.txt\n");
    Inventory const less = inventory({PackPart::individuals});
    EXPECT_THAT(paths(less.left_out), ElementsAre("runs/kb1/001/all.lore"));
    EXPECT_EQ(less.files.size() + 1, all.files.size());
}

TEST_F(InventoryTest, keeps_inputs_in_the_same_places_to_each_other) {
    fs::create_directories(scratch.file("jobs/campaigns"));
    fs::create_directories(scratch.file("jobs/tasks"));
    put("jobs/tasks/source.toml", read(scratch.file("source.toml")));
    put("jobs/campaigns/c.toml", "title = \"C\"\n[source]\nconfig = \"../tasks/source.toml\"\n");
    put("c/notes.txt", "abc");
    CampaignPlan const plan = read_campaign(scratch.file("jobs/campaigns/c.toml"));
    EXPECT_THAT(paths(take_inventory(plan, directory(), {}, [] {}).files),
                ElementsAre("inputs/campaigns/c.toml", "inputs/tasks/source.toml", "notes.txt"));
    CampaignPlan const moved = plan_in_pack(plan);
    EXPECT_EQ(moved.path, "inputs/campaigns/c.toml");
    EXPECT_EQ(moved.config_path(moved.sources.front()), "inputs/tasks/source.toml");
}

TEST_F(InventoryTest, has_the_files_that_the_worlds_are_made_of) {
    put("lib/toy.so", "a library");
    put("jobs/mine/world.py", "a program");
    put("jobs/mine/arm", "a program of its own");
    fs::permissions(scratch.file("jobs/mine/arm"), fs::perms::owner_exec, fs::perm_options::add);
    put("jobs/searched.toml", "[world]\nlibrary = \"toy\"\n");
    put("jobs/named.toml", "[world]\nlibrary = \"../lib/toy.so\"\n");
    put("jobs/process.toml", "[world]\nprocess = [\"/bin/sh\", \"mine/world.py\", \"--fast\"]\n");
    put("jobs/own.toml", "[world]\nprocess = [\"mine/arm\"]\n");
    put("jobs/built_in.toml", "[world]\nlibrary = \"collectball:source\"\n");
    std::string text = "title = \"C\"\n[source]\nconfig = \"searched.toml\"\n";
    for (std::string const name : {"named", "process", "own", "built_in"})
        text += "[[treatment]]\nname = \"" + name + "\"\nconfig = \"" + name + ".toml\"\n";
    put("jobs/c.toml", text);
    put("c/notes.txt", "abc");
    ::setenv("LORE_WORLD_PATH", scratch.file("lib").c_str(), 1);
    CampaignPlan const plan = read_campaign(scratch.file("jobs/c.toml"));
    Inventory const all = take_inventory(plan, directory(), {}, [] {});
    auto const places = places_of_worlds(plan);
    ::unsetenv("LORE_WORLD_PATH");
    EXPECT_THAT(paths(all.files),
                ElementsAre("inputs/jobs/built_in.toml", "inputs/jobs/c.toml", "inputs/jobs/mine/arm",
                            "inputs/jobs/mine/world.py", "inputs/jobs/named.toml", "inputs/jobs/own.toml",
                            "inputs/jobs/process.toml", "inputs/jobs/searched.toml", "inputs/jobs/toy.so",
                            "inputs/lib/toy.so", "notes.txt"))
        << "a library that was looked for lies where it is looked for first";
    for (PackedFile const& file : all.files) EXPECT_EQ(file.executable, file.path == "inputs/jobs/mine/arm");
    EXPECT_THAT(places, ElementsAre(Pair("named", ElementsAre("inputs/lib/toy.so")),
                                    Pair("own", ElementsAre("inputs/jobs/mine/arm")),
                                    Pair("process", ElementsAre("inputs/jobs/mine/world.py")),
                                    Pair("source", ElementsAre("inputs/jobs/toy.so"))));
}

TEST_F(InventoryTest, refuses_links_special_files_and_names_that_not_every_archive_can_have) {
    put("c/notes.txt", "abc");
    fs::create_symlink("/etc/passwd", scratch.file("c/link"));
    EXPECT_THAT(test::complaint_of([&] { inventory(); }), HasSubstr("it is a link"));
    fs::remove(scratch.file("c/link"));
    ASSERT_EQ(::mkfifo(scratch.file("c/pipe").c_str(), 0600), 0);
    EXPECT_THAT(test::complaint_of([&] { inventory(); }), HasSubstr("it is no regular file"));
    fs::remove(scratch.file("c/pipe"));
    put("c/two\nlines", "");
    EXPECT_THAT(test::complaint_of([&] { inventory(); }), HasSubstr("control characters"));
}
