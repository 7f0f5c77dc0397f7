// This file draws plots with gnuplot, which runs as a child process.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace remap {

// Throws kOutput with the name of Debian's package if gnuplot cannot be started.
void require_gnuplot();

// These are colors that color-blind readers can distinguish (Okabe and Ito 2008).
inline constexpr std::array<const char*, 6> kPlotColors = {"#0072B2", "#D55E00", "#009E73",
                                                           "#CC79A7", "#E69F00", "#56B4E9"};

// Returns the gnuplot commands with which every plot starts: an SVG or PNG of `width` x `height` pixels with
// a light grid.
std::string plot_style(int width, int height, bool is_png = false);

// Quotes `text` for a script, so that no character has a special meaning for gnuplot. In double quotes,
// gnuplot would run a command between backquotes.
std::string gnuplot_text(const std::string& text);

// Writes the SVG or PNG that gnuplot draws for `script`. Throws kOutput if the file cannot be written, or if
// gnuplot cannot be started or fails. The message has the first line of gnuplot's error.
void write_drawing(const std::filesystem::path& path, const std::string& script);

}  // namespace remap
