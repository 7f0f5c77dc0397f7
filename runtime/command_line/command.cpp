#include "command_line/command.hpp"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Returns `--output` for `-o,--output FILE`, and `DIR` for `DIR`.
std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name(true) : "--" + option.get_lnames().front();
}

}  // namespace

void fail_unknown(const std::string& option, const std::string& noun, const std::string& word,
                  const std::vector<std::string>& known) {
  throw usage_error(option + ": unknown " + noun + " '" + word + "'" + suggestion(word, known));
}

Option* Option::required() {
  option_->required();
  return this;
}

Option* Option::delimiter(char character) {
  option_->delimiter(character);
  return this;
}

Option* Option::allow_extra_args(bool allowed) {
  option_->allow_extra_args(allowed);
  return this;
}

Option* Option::expected(int min, int max) {
  option_->expected(min, max);
  return this;
}

Option* Option::type_size(int count) {
  option_->type_size(count);
  return this;
}

Option* Option::excludes(Option* other) {
  option_->excludes(other->option_);
  return this;
}

Option* Option::needs(Option* other) {
  option_->needs(other->option_);
  return this;
}

Option* Option::default_text(const std::string& text) {
  option_->default_str(text);
  return this;
}

Option* Option::common() {
  option_->group("Options");
  return this;
}

Option* Option::tag(OptionTags tags) {
  tags_ |= tags;
  return this;
}

Option* Option::environment(const std::string& name) {
  option_->envname(name);
  return this;
}

Option* Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return this;
}

Option* Option::positive() {
  option_->check(CLI::PositiveNumber);
  return this;
}

Option* Option::range(int min, int max) {
  option_->check(CLI::Range(min, max));
  return this;
}

Option* Option::range(std::int64_t min, std::int64_t max) {
  option_->check(CLI::Range(min, max));
  return this;
}

Option* Option::range(std::size_t min, std::size_t max) {
  option_->check(CLI::Range(min, max));
  return this;
}

Command::Command(const std::string& description, const std::string& name)
    : app_(std::make_shared<CLI::App>(description, name)) {}

Command::Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

Command* Command::add_subcommand(const std::string& name, const std::string& description,
                                 const std::string& group) {
  // CLI::App owns its subcommands. So this pointer shares the ownership of the parent.
  std::shared_ptr<CLI::App> subcommand(app_, app_->add_subcommand(name, description));
  if (!group.empty()) subcommand->group(group);
  commands_.push_back(std::unique_ptr<Command>(new Command(std::move(subcommand))));
  return commands_.back().get();
}

Option* Command::keep(CLI::Option* option) {
  options_.push_back(std::make_unique<Option>(option));
  return options_.back().get();
}

template <OptionValue T>
Option* Command::add_option(const std::string& names, T& value, const std::string& description) {
  const std::size_t space = names.find(' ');
  CLI::Option* option = app_->add_option(names.substr(0, space), value, description);
  if (space != std::string::npos) option->type_name(names.substr(space + 1));
  if constexpr (requires { value.empty(); }) {
    if (value.empty()) return keep(option);
  }
  return keep(option->capture_default_str());
}

template Option* Command::add_option(const std::string&, std::string&, const std::string&);
template Option* Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template Option* Command::add_option(const std::string&, int&, const std::string&);
template Option* Command::add_option(const std::string&, unsigned&, const std::string&);
template Option* Command::add_option(const std::string&, std::int64_t&, const std::string&);
template Option* Command::add_option(const std::string&, std::size_t&, const std::string&);
template Option* Command::add_option(const std::string&, double&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<std::size_t>&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option* Command::add_option(const std::string&, std::vector<std::filesystem::path>&,
                                     const std::string&);

Option* Command::add_flag(const std::string& names, bool& value, const std::string& description) {
  return keep(app_->add_flag(names, value, description));
}

Option* Command::add_words(
    const std::string& names,
    const std::function<void(const std::string& option, const std::string& word)>& take,
    const std::vector<std::string>& choices, const std::string& description) {
  const std::size_t space = names.find(' ');
  CLI::Option* option = app_->add_option(
      names.substr(0, space),
      [take, this, index = options_.size()](const CLI::results_t& words) {
        for (const std::string& word : words) take(name_of(*options_[index]->option_), word);
        return true;
      },
      description);
  option->type_name(space == std::string::npos ? "TEXT" : names.substr(space + 1));
  if (!choices.empty())  // the reader refuses other words and lists the choices itself
    option->check(
        CLI::Validator([](std::string&) { return std::string(); }, "{" + CLI::detail::join(choices) + "}"));
  return keep(option);
}

void Command::retire(const std::string& name, const std::string& remedy) {
  app_->add_flag_callback(name, [name, remedy] { throw usage_error(name + ": " + remedy); })->group("");
}

void Command::retire_command(const std::string& name, const std::string& remedy) {
  app_->add_subcommand(name)->prefix_command()->group("")->callback(
      [name, remedy] { throw usage_error(name + ": " + remedy); });
}

void Command::option_group(const std::string& name) { app_->option_defaults()->group(name); }

Option* Command::option(const std::string& name) {
  const CLI::Option* wanted = app_->get_option(name);
  return std::ranges::find_if(options_, [wanted](const auto& option) { return option->option_ == wanted; })
      ->get();
}

void Command::set_version_flag(const std::string& names, const std::string& version) {
  app_->set_version_flag(names, version);
}

void Command::require_subcommand(int count) { app_->require_subcommand(count); }

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::callback(std::function<void()> work) { app_->callback(std::move(work)); }

std::size_t Command::count(const std::string& option) const { return app_->count(option); }

OptionTags Command::tags_of(const std::string& name) const {
  const auto found =
      std::ranges::find_if(options_, [&](const auto& option) { return name_of(*option->option_) == name; });
  return found == options_.end() ? 0 : (*found)->tags_;
}

std::vector<GivenOption> Command::given() const {
  std::vector<GivenOption> all;
  for (const auto& option : options_)
    if (const CLI::Option& own = *option->option_; own.count() > 0)
      all.push_back({name_of(own), own.get_expected_max() == 0 ? std::vector<std::string>() : own.results(),
                     option->tags_});
  return all;
}

}  // namespace remap
