#include "report/fit_plot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <sys/wait.h>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

// These are colors that color-blind readers can distinguish (Okabe and Ito 2008).
constexpr std::array<const char*, 6> kPlotColors = {"#0072B2", "#D55E00", "#009E73",
                                                    "#CC79A7", "#E69F00", "#56B4E9"};

// Runs `gnuplot argument` and returns its exit code, or -1 if a signal ended it.
int run(const std::string& argument, const std::string& output, const std::string& complaints) {
  constexpr int kNotFound = 127;  // the shell's code for a program that cannot be started
  const std::string command = "exec gnuplot " + shell_word(argument) + " </dev/null >" + shell_word(output) +
                              " 2>" + shell_word(complaints);
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status)) return -1;
  if (WEXITSTATUS(status) == kNotFound)
    throw output_error("--plot: gnuplot cannot be started: " + std::string(std::strerror(ENOENT)) +
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

// Throws kOutput with the name of Debian's package if gnuplot cannot be started.
void require_gnuplot() {
  const ScratchFolder folder("remapc-plot");
  const int code = run("--version", folder.file("output"), folder.file("complaints"));
  if (code != 0)
    throw output_error("--plot: gnuplot --version failed (" + std::to_string(code) +
                       ", install the package gnuplot-nox)");
}

// Returns the gnuplot commands with which a plot starts: an SVG or PNG with a light grid.
std::string plot_style(bool is_png) {
  return std::string("set terminal ") + (is_png ? "pngcairo" : "svg") +
         " size 1280,1040 enhanced font 'Helvetica,13' background rgb 'white'\n"
         "set grid linecolor rgb '#dddddd' linetype 1\nset border linecolor rgb '#888888'\n"
         "set tics textcolor rgb 'black'\n";
}

// Quotes `text` for a script, so that no character has a special meaning for gnuplot. In double quotes,
// gnuplot would run a command between backquotes.
std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : plain(text)) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

// Writes the SVG or PNG that gnuplot draws for `script`. Throws kOutput if the file cannot be written, or if
// gnuplot cannot be started or fails. The message has the first line of gnuplot's error.
void write_drawing(const std::filesystem::path& path, const std::string& script) {
  const ScratchFolder folder("remapc-plot");
  write_file(folder.file("script"), script);
  const int code = run(folder.file("script"), folder.file("output"), folder.file("complaints"));
  const std::string complaints = read_file(folder.file("complaints"));
  // Messages with exit code 0 are warnings.
  if (code != 0)
    throw output_error("--plot: gnuplot failed (" + std::to_string(code) + "): " + complaint(complaints));
  const std::string picture = read_file(folder.file("output"));
  // gnuplot does not detect that a disk is full.
  if (picture.find("</svg>") == std::string::npos && picture.find("IEND") == std::string::npos)
    throw output_error(
        "--plot: the output of gnuplot is incomplete (check the free space for temporary files)");
  write_file(path, picture);
}

constexpr std::size_t kMostRows = 2000;
constexpr int kCurvePoints = 200;
constexpr const char* kLimitColor = "#999999";
constexpr std::size_t kCurves = 5;  // number of alphas whose specular is drawn

// This is the least error that is drawn. Smaller errors are rounding.
constexpr double kLeastError = 1e-8;

std::string shown_error(double error) { return number_text(std::max(std::fabs(error), kLeastError)); }

// Chooses `count` values, evenly by their rank. The smallest and the largest are among them.
std::vector<double> spread(const std::set<double>& values, std::size_t count) {
  const std::vector<double> sorted(values.begin(), values.end());
  std::vector<double> chosen;
  for (std::size_t i = 0; i < std::min(count, sorted.size()); ++i)
    chosen.push_back(sorted[count >= sorted.size() ? i : i * (sorted.size() - 1) / (count - 1)]);
  return chosen;
}

class Plot {
 public:
  Plot(const Table& table, const std::vector<Fit>& fits) : fits_(fits), fit_(fits.front()) {
    rows_ = draw_rows(answer_rows(table), kMostRows, 1);
    for (const TableRow& row : rows_) {
      alphas_.insert(row.alpha1);
      speculars_.insert(row.specular1);
    }
  }

  std::string script(bool is_png) {
    write_data();
    out_ << plot_style(is_png)
         << "set multiplot layout 2,2 margins 0.07,0.98,0.16,0.92 spacing 0.08,0.11 title "
         << gnuplot_text(fit_.source.model + " to " + fit_.target.model + ", " +
                         std::to_string(rows_.size()) + " rows of " + fit_.table.name)
         << " noenhanced font ',16'\n"
         << "set key font ',11' noenhanced\n";
    alpha_panel();
    specular_panel();
    residual_panel("alpha", 2);
    residual_panel(fit_.target.specular, 3);
    out_ << "unset multiplot\n";
    return out_.str();
  }

 private:
  void write_data() {
    out_ << "$rows << EOD\n";
    for (const TableRow& row : rows_)
      out_ << number_text(row.alpha1) << ' ' << number_text(row.specular1) << ' ' << number_text(row.alpha2)
           << ' ' << number_text(row.specular2) << ' ' << at_limit(row) << '\n';
    out_ << "EOD\n";
    const double middle = *std::next(speculars_.begin(), static_cast<std::ptrdiff_t>(speculars_.size() / 2));
    shown_ = spread(alphas_, kCurves);
    for (std::size_t f = 0; f < fits_.size(); ++f) {
      write_residuals(f);
      write_alpha_curve(f, middle);
      write_specular_curves(f);
    }
    out_ << "$shown << EOD\n";
    for (const TableRow& row : rows_)
      if (std::ranges::find(shown_, row.alpha1) != shown_.end())
        out_ << number_text(row.specular1) << ' ' << number_text(row.specular2) << ' ' << at_limit(row)
             << '\n';
    out_ << "EOD\n";
  }

  // Returns 1 if the target is at a limit, otherwise 0.
  int at_limit(const TableRow& row) const { return row.status == RowStatus::kOk ? 0 : 1; }

  void write_residuals(std::size_t f) {
    out_ << "$residuals" << f << " << EOD\n";
    for (const TableRow& row : rows_) {
      const MappedTexel texel = evaluate_fit(fits_[f], row.alpha1, row.specular1);
      out_ << number_text(row.alpha1) << ' ' << shown_error(texel.alpha - row.alpha2) << ' '
           << shown_error(texel.specular - row.specular2) << '\n';
    }
    out_ << "EOD\n";
  }

  void write_alpha_curve(std::size_t f, double specular) {
    out_ << "$alpha" << f << " << EOD\n";
    const Range& range = fit_.domain.alpha;
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double alpha = range.min + (range.max - range.min) * i / kCurvePoints;
      out_ << number_text(alpha) << ' ' << number_text(evaluate_fit(fits_[f], alpha, specular).alpha) << '\n';
    }
    out_ << "EOD\n";
  }

  // A blank line ends the curve of one alpha.
  void write_specular_curves(std::size_t f) {
    out_ << "$specular" << f << " << EOD\n";
    for (const double alpha : shown_) {
      for (int i = 0; i <= kCurvePoints / 4; ++i) {
        const double specular = fit_.domain.specular.max * i / (kCurvePoints / 4);
        out_ << number_text(specular) << ' ' << number_text(evaluate_fit(fits_[f], alpha, specular).specular)
             << '\n';
      }
      out_ << '\n';
    }
    out_ << "EOD\n";
  }

  void axes(const std::string& title, const std::string& x, const std::string& y) {
    out_ << "set title " << gnuplot_text(title) << " noenhanced\nset xlabel " << gnuplot_text(x)
         << " noenhanced\nset ylabel " << gnuplot_text(y) << " noenhanced\n";
  }

  // Plots curves. The first line is the widest, so that lines below others stay visible. The rows are drawn
  // last, from the data block `rows`: column `y` over column `x`. Column `limit` marks rows whose target is
  // at a limit.
  void plot_curves(const std::string& block, const std::string& rows, int x, int y, int limit) {
    // gnuplot requires a range even if all values are 0.
    out_ << "set yrange [0:1e-3<*]\nset key left top Left reverse\nplot ";
    for (std::size_t f = 0; f < fits_.size(); ++f)
      out_ << "$" << block << f << " using 1:2 with lines linewidth "
           << 1.2 + 1.8 * static_cast<double>(fits_.size() - 1 - f) << " linecolor rgb '" << kPlotColors[f]
           << "' title " << gnuplot_text(fit_label(fits_[f])) << ", ";
    const auto points = [&](int at_limit, const std::string& color) {
      out_ << rows << " using " << x << ":($" << limit << "==" << at_limit << "?$" << y
           << ":NaN) with points pointtype 7 pointsize 0.25 linecolor rgb '" << color << "' title ";
    };
    points(0, "black");
    out_ << "'rows'";
    if (std::ranges::any_of(rows_, [&](const TableRow& row) { return at_limit(row) != 0; })) {
      out_ << ", ";
      points(1, kLimitColor);
      out_ << "'rows at a limit of the target'";
    }
    out_ << "\nunset yrange\n";
  }

  void alpha_panel() {
    axes("Target alpha; curves at the middle " + fit_.source.specular, "alpha of " + fit_.source.model,
         "alpha of " + fit_.target.model);
    plot_curves("alpha", "$rows", 1, 3, 5);
  }

  void specular_panel() {
    std::string alphas;
    for (const double alpha : shown_)
      alphas += (alphas.empty() ? "" : ", ") + number_text(std::round(alpha * 1000.0) / 1000.0);
    axes("Target " + fit_.target.specular + " at alpha " + alphas,
         fit_.source.specular + " of " + fit_.source.model,
         fit_.target.specular + " of " + fit_.target.model);
    plot_curves("specular", "$shown", 1, 2, 3);
  }

  // The axis is logarithmic, because the errors of the kinds differ by powers of ten.
  void residual_panel(const std::string& output, int column) {
    axes("Error of each fit in " + output, "alpha of " + fit_.source.model, "|fit - row|, " + output);
    out_ << "set logscale y\nset yrange [*:1e-6<*]\nset format y '10^{%T}'\n"
         << "set key at graph 0.5,-0.19 center top Left reverse maxcols 1\nplot ";
    for (std::size_t f = 0; f < fits_.size(); ++f) {
      const Residuals residuals = residuals_of(rows_, fits_[f]);
      const double rms = error_figures(column == 2 ? residuals.alpha : residuals.specular).rms;
      out_ << (f == 0 ? "" : ", ") << "$residuals" << f << " using 1:" << column
           << " with points pointtype 7 pointsize 0.3 linecolor rgb '" << kPlotColors[f] << "' title "
           << gnuplot_text(fit_label(fits_[f]) + ", rms " + error_text(rms));
    }
    out_
        << "\nunset logscale y\nunset yrange\nset format y\nset key default\nset key font ',11' noenhanced\n";
  }

  const std::vector<Fit>& fits_;
  const Fit& fit_;  // the first fit; all have the same models, table and domain
  std::vector<TableRow> rows_;
  std::set<double> alphas_, speculars_;
  std::vector<double> shown_;  // alphas of the second panel
  std::ostringstream out_;
};

bool is_png(const std::filesystem::path& path) { return path.extension() == ".png"; }

}  // namespace

void require_plot(const std::filesystem::path& path) {
  if (path.extension() != ".svg" && !is_png(path))
    throw usage_error("--plot " + path.string() + ": the file name must end with .svg or .png");
  require_gnuplot();
  create_parent(path);
}

void write_plot(const std::filesystem::path& path, const Table& table, const std::vector<Fit>& fits) {
  const std::vector<Fit> drawn(
      fits.begin(), fits.begin() + static_cast<std::ptrdiff_t>(std::min(fits.size(), kPlotColors.size())));
  write_drawing(path, Plot(table, drawn).script(is_png(path)));
}

std::string fit_label(const Fit& fit) {
  const auto form = fit.method.find("form");
  return kind_name(fit.mapping) + (form == fit.method.end() ? "" : " " + form->second);
}

}  // namespace remap
