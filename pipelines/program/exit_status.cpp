#include "pipelines/program/exit_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// Every line of the message, behind who says it.
int complain(const std::string& who, const std::string& message, int status) {
  std::fflush(stdout);
  std::string text;
  for (std::size_t at = 0; at <= message.size();) {
    const std::size_t end = std::min(message.find('\n', at), message.size());
    text += fmt::format("{}: {}\n", who, message.substr(at, end - at));
    at = end + 1;
  }
  std::fputs(text.c_str(), stderr);
  return status;
}

}  // namespace

int exit_status_of(const std::string& who, const std::function<void()>& command) {
  try {
    command();
    return 0;
  } catch (const SceneError& error) {
    return complain(who, error.what(), 2);
  } catch (const SolverError& error) {
    return complain(who, error.what(), 3);
  } catch (const DataError& error) {
    return complain(who, error.what(), 4);
  } catch (const Interrupted& error) {
    return complain(who, error.what(), 130);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(who, error.what(), 4);
  } catch (const std::bad_alloc&) {
    return complain(who, "out of memory; make the sample or the number of frames smaller", 3);
  } catch (const std::exception& error) {
    return complain(who, fmt::format("a fault of the program itself: {}", error.what()), 3);
  }
}

}  // namespace lamella
