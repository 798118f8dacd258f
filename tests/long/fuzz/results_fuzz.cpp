// What a campaign left in its directory; the first byte says which file the rest is.

#include "fuzz_input.h"
#include "results.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/state.h>

#include <filesystem>

using namespace lore;
namespace fs = std::filesystem;

namespace {

constexpr char const* tables[]{"runs.csv", "curves.csv", "kbs.csv", "replay.csv", "values.csv"};   // as in make_seeds

/// A directory whose one file of interest lies in memory; a report needs at least the other two.
class MadeUpCampaign {
public:
    MadeUpCampaign() {
        std::string place = (fs::temp_directory_path() / "lore-fuzz-XXXXXX").string();
        if (::mkdtemp(place.data()) == nullptr) std::abort();
        directory = CampaignDirectory{place};
        std::string const record = directory.record(step.name);
        fs::create_directories(fs::path{record}.parent_path());
    }
    ~MadeUpCampaign() { fs::remove_all(directory.path()); }
    void read_with(std::string const& name, fuzz::MemoryFile const& file) {
        put("final.csv", final_runs);
        put("curves.csv", curves);
        put("scene.json", scene);
        put("replay.csv", replay);
        put("values.csv", values);
        put(name, file);
        fuzz::accepts([&] { read_results(directory); });
        fs::remove(directory.file(name));
    }
    void read_failure_of(fuzz::MemoryFile const& file) {
        fs::create_symlink(file.path(), directory.record(step.name));
        fuzz::accepts([&] { read_failure(directory, step); });
        fs::remove(directory.record(step.name));
    }

private:
    void put(std::string const& name, fuzz::MemoryFile const& file) {
        fs::remove(directory.file(name));
        fs::create_symlink(file.path(), directory.file(name));
    }
    static std::span<std::byte const> bytes(std::string_view text) {
        return std::as_bytes(std::span{text.data(), text.size()});
    }

    CampaignDirectory directory{""};
    Step const step{"a", StepKind::evolve, "a", "a", 1, {}};
    fuzz::MemoryFile const final_runs{bytes("treatment,run,seed,balls\nnone,1,7,4\n")};
    fuzz::MemoryFile const curves{bytes("treatment,generation,runs,mean,low,high\nnone,0,1,0,0,0\n")};
    // The names are those of the seeds in tests/long/browser/sample.
    fuzz::MemoryFile const scene{bytes(
        R"({"replays": [{"run": "source/002", "signature": "", "scene": {"width": 1, "height": 1, "walls": [], "doors": [],
        "balls": [], "balls_at_start": true, "basket": [0, 0, 1], "basket_lights": [[0, 0]], "switch": [0, 0],
        "robot_radius": 1}}], "panels": [{"figure": "figure5", "knowledge": "kb1", "checksum": ""}]})")};
    fuzz::MemoryFile const replay{bytes("replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected\n"
                                        "source/002,0,1,1,0,0,0,0,1,0\n")};
    fuzz::MemoryFile const values{bytes("figure,knowledge,window,value\nfigure5,kb1,0,1\n")};
};

}   // namespace

void read_input(std::span<std::byte const> input) {
    static MadeUpCampaign campaign;
    if (input.empty()) return;
    fuzz::MemoryFile const stored{input.subspan(1)};
    std::size_t const which = std::to_integer<std::size_t>(input[0]) % (std::size(tables) + 6);
    if (which < std::size(tables)) campaign.read_with(tables[which], stored);
    else if (which == std::size(tables)) fuzz::accepts([&] { read_choice(stored.path()); });
    else if (which == std::size(tables) + 1) campaign.read_failure_of(stored);
    else if (which == std::size(tables) + 2) campaign.read_with("population.csv", stored);
    else if (which == std::size(tables) + 3) campaign.read_with("scene.json", stored);
    else if (which == std::size(tables) + 4) campaign.read_with("speed.csv", stored);
    else campaign.read_with("leads.csv", stored);
}
