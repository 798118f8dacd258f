#include <lore/campaign/slurm.h>

#include "campaign_fixture.h"
#include "support/complaint.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;

class Slurm : public test::CampaignTest {
protected:
    std::vector<BatchJob> jobs(std::string const& name = "c") const {
        return batch_jobs(plan(), directory(name), options().launcher, "/opt/lore-campaign");
    }
    BatchJob job(std::string const& group, std::string const& name = "c") const {
        auto const all = jobs(name);
        auto const found = std::find_if(all.begin(), all.end(), [&](BatchJob const& j) { return j.group == group; });
        return found == all.end() ? BatchJob{} : *found;
    }
};

TEST_F(Slurm, makes_arrays_of_runs_and_lets_them_wait) {
    EXPECT_EQ(jobs().front().group, "source");
    EXPECT_EQ(jobs().back().group, "report");
    EXPECT_NE(job("source").text.find("#SBATCH --array=1-4%100\n"), std::string::npos) << job("source").text;
    EXPECT_EQ(job("choose").after_any, std::vector<std::string>{"source"});
    EXPECT_EQ(job("kb1").after, std::vector<std::string>{"knowledge/kb1"});
    EXPECT_TRUE(job("none").after.empty());
    EXPECT_EQ(job("report").after_any.size(), jobs().size() - 1);
}

TEST_F(Slurm, warns_requeues_and_limits) {
    std::string const text = job("none").text;
    for (char const* line : {"#SBATCH --time=04:00:00\n", "#SBATCH --signal=B:USR1@120\n", "#SBATCH --requeue\n",
                             "scontrol requeue", "--only \"$step\""})
        EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST_F(Slurm, writes_its_logs_into_directories_of_any_name) {
    std::string const text = job("none", "runs of 100 %j").text;
    EXPECT_NE(text.find("#SBATCH --output=\"/"), std::string::npos) << text;
    EXPECT_NE(text.find("/runs of 100 %%j/logs/slurm-none-%a.out\"\n"), std::string::npos) << text;
}

TEST_F(Slurm, leaves_out_what_is_done) {
    RunnerOptions some = options();
    some.only = {"source/001", "source/003", "none"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    EXPECT_NE(job("source").text.find("#SBATCH --array=2,4%100\n"), std::string::npos);
    EXPECT_EQ(job("none").group, "") << "nothing is left of it";
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    EXPECT_EQ(jobs().size(), 1u) << "only the report";
}

TEST_F(Slurm, finds_the_id_of_a_job_among_all_that_sbatch_says) {
    std::filesystem::create_directories(scratch.file("bin"));
    write("bin/sbatch", "#!/bin/sh\necho 'sbatch: INFO: of the site' >&2\necho x >>" + scratch.file("count") +
                            "\necho \"$((1000 + $(wc -l <" + scratch.file("count") + ")));cluster\"\n" +
                            "echo \"$@\" >>" + scratch.file("asked") + "\n");
    std::filesystem::permissions(scratch.file("bin/sbatch"), std::filesystem::perms::owner_all);
    std::string const before = std::getenv("PATH");
    ::setenv("PATH", (scratch.file("bin") + ":" + before).c_str(), 1);
    testing::internal::CaptureStderr();
    auto const lines = submit_campaign(plan(), directory(), options().launcher, "/opt/lore-campaign", false);
    EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("sbatch: INFO: of the site\n"));
    EXPECT_EQ(lines.front(), "1001 source (4 tasks)");
    EXPECT_TRUE(read(directory().file("slurm/jobs.txt")).starts_with("1001 source\n1002 choose\n"));
    EXPECT_NE(read(scratch.file("asked")).find("--dependency=afterany:1001 "), std::string::npos);

    write("bin/sbatch", "#!/bin/sh\necho submitted\n");
    EXPECT_EQ(test::complaint_of<Error>(
                  [&] { submit_campaign(plan(), directory("d"), options().launcher, "/opt/lore-campaign", false); }),
              "cannot tell which job was submitted (sbatch printed no job id, but 'submitted'). Look at 'squeue --me', "
              "and cancel what is there.");
    ::setenv("PATH", before.c_str(), 1);
}
