#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace concave_distance {

/// The folders from the lowest to the highest; an include may only point to the same folder or a lower one.
const std::vector<std::string>& foldersFromTheGround();

/// What is wrong with one file's includes, a sentence each; empty when nothing is.
/// @param file its path below src or include/concave_distance
/// @param own_header for a .cpp beside a header of the same name: what its first include must be; else empty
std::vector<std::string> faultsOfIncludes(const std::string& text, const std::filesystem::path& file,
                                          const std::string& own_header);

/// The faults of every header and source file below `package`, each with its file's path.
/// @param files_seen counts them, so that a scan of nothing cannot pass for a clean one
std::vector<std::string> faultsOfFolders(const std::filesystem::path& package, std::size_t& files_seen);

}  // namespace concave_distance
