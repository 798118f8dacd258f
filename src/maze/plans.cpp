// The mazes. Walls, starts and goals are those of the files medium_maze.txt and hard_maze.txt that accompany
// reimplementations of the experiment (goNEAT_NS; I. Omelianenko, Hands-On Neuroevolution with Python, 2019).
#include <lore/maze/maze.h>

#include <lore/core/error.h>

#include <fmt/format.h>

namespace lore {

namespace {

MazePlan const medium{"medium",
                      300,
                      140,
                      {30, 22},
                      {270, 100},
                      {{5, 5, 295, 5},
                       {295, 5, 295, 135},
                       {295, 135, 5, 135},
                       {5, 135, 5, 5},
                       {241, 135, 58, 65},
                       {114, 5, 73, 42},
                       {130, 91, 107, 46},
                       {196, 5, 139, 51},
                       {219, 125, 182, 63},
                       {267, 5, 214, 63},
                       {271, 135, 237, 88}}};

MazePlan const hard{"hard",
                    205,
                    205,
                    {36, 184},
                    {31, 20},
                    {{5, 5, 5, 200},
                     {5, 200, 200, 200},
                     {200, 200, 200, 5},
                     {200, 5, 5, 5},
                     {5, 49, 57, 53},
                     {56, 54, 56, 157},
                     {57, 106, 158, 162},
                     {77, 200, 108, 164},
                     {5, 80, 33, 121},
                     {200, 146, 87, 91},
                     {56, 55, 133, 30}}};

}   // namespace

MazePlan const& maze_plan(std::string const& name) {
    for (MazePlan const* plan : {&medium, &hard})
        if (plan->name == name) return *plan;
    throw UsageError(fmt::format("there is no maze '{}'", name), "those are: medium, hard", "Correct the name.");
}

}   // namespace lore
