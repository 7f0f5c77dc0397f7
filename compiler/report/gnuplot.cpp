#include "report/gnuplot.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sys/wait.h>

#include "core/files.hpp"
#include "core/plain_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Runs `gnuplot argument` and returns its exit code, or -1 if a signal ended it.
int run(const std::string& argument, const std::string& output, const std::string& complaints) {
  constexpr int kNotFound = 127;  // the shell's code for a program that cannot be started
  const std::string command = "exec gnuplot " + shell_word(argument) + " </dev/null >" + shell_word(output) +
                              " 2>" + shell_word(complaints);
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status)) return -1;
  if (WEXITSTATUS(status) == kNotFound)
    throw Error(ErrorKind::kOutput,
                "--plot: gnuplot cannot be started: " + std::string(std::strerror(ENOENT)) +
                    " (install gnuplot, on Debian the package gnuplot-nox)");
  return WEXITSTATUS(status);
}

// Returns the line of gnuplot's message that states the error. The lines before it only show the place.
std::string complaint(const std::string& text) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find("line ") != std::string::npos || line.find("rror") != std::string::npos) return line;
    begin = end + 1;
  }
  return text.substr(0, text.find('\n'));
}

}  // namespace

void require_gnuplot() {
  const ScratchFolder folder("remapc-plot");
  const int code = run("--version", folder.file("output"), folder.file("complaints"));
  if (code != 0)
    throw Error(ErrorKind::kOutput, "--plot: gnuplot --version failed (" + std::to_string(code) +
                                        ", install the package gnuplot-nox)");
}

std::string plot_style(int width, int height, bool is_png) {
  return std::string("set terminal ") + (is_png ? "pngcairo" : "svg") + " size " + std::to_string(width) +
         "," + std::to_string(height) +
         " enhanced font 'Helvetica,13' background rgb 'white'\n"
         "set grid linecolor rgb '#dddddd' linetype 1\nset border linecolor rgb '#888888'\n"
         "set tics textcolor rgb 'black'\n";
}

std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : plain(text)) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

void write_drawing(const std::filesystem::path& path, const std::string& script) {
  const ScratchFolder folder("remapc-plot");
  write_file(folder.file("script"), script);
  const int code = run(folder.file("script"), folder.file("output"), folder.file("complaints"));
  const std::string complaints = read_file(folder.file("complaints"));
  // Messages with exit code 0 are warnings.
  if (code != 0)
    throw Error(ErrorKind::kOutput,
                "--plot: gnuplot failed (" + std::to_string(code) + "): " + complaint(complaints));
  const std::string picture = read_file(folder.file("output"));
  // gnuplot does not detect that a disk is full.
  if (picture.find("</svg>") == std::string::npos && picture.find("IEND") == std::string::npos)
    throw Error(ErrorKind::kOutput,
                "--plot: the output of gnuplot is incomplete (check the free space for temporary files)");
  write_file(path, picture);
}

}  // namespace remap
