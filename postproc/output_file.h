// Writing files so that each is complete or as before: to a temporary name beside the target, then renamed.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace lamella {

/// `write` receives the temporary name. Throws DataError with the system's reason; then nothing is left behind.
void replace_output(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);
void write_text_file(const std::filesystem::path& path, const std::string& text);
std::string read_binary_file(const std::filesystem::path& path);
void make_folder(const std::filesystem::path& folder);

}  // namespace lamella
