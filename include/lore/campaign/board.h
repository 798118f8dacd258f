#pragma once

#include <string>
#include <vector>

namespace lore {

/// What a campaign at work shows on stderr: on a terminal one live line a running step and a last one for the whole,
/// drawn anew in place; otherwise only the lines that announce something.
class Board {
public:
    explicit Board(bool quiet);
    ~Board();
    Board(Board const&) = delete;
    Board& operator=(Board const&) = delete;

    bool live() const { return live_; }
    /// A line that stays.
    void announce(std::string const& line);
    /// Said even where quiet is wanted.
    void complain(std::string const& line);
    /// The live lines as of now.
    void draw(std::vector<std::string> lines);

private:
    void erase();
    bool quiet_, live_;
    std::vector<std::string> lines_;
};

/// [#####.....], `width` characters between the brackets.
std::string bar(double share, int width);

}   // namespace lore
