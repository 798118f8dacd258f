#pragma once

#include <string>

namespace lore {

/// A directory that is filled under another name and gets its own when it is whole; without keep() it goes away with
/// all that is in it.
class NewDirectory {
public:
    /// Throws UsageError if there is something of that name.
    explicit NewDirectory(std::string name);
    ~NewDirectory();
    NewDirectory(NewDirectory const&) = delete;
    NewDirectory& operator=(NewDirectory const&) = delete;

    std::string const& path() const { return path_; }   ///< where to write
    /// Throws Error, also if somebody has taken the name meanwhile.
    void keep();

private:
    std::string name_, path_;
    bool kept_ = false;
};

/// Gives `from` the name `to` unless something has it: what is there is never replaced. Throws Error.
void rename_without_replacing(std::string const& from, std::string const& to);

}   // namespace lore
