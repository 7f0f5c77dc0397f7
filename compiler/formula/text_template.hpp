// Returns ASCII letters as capitals, for include guards.
std::string upper_case(std::string text);

// Return the shortest literals that read back as the same number: for the float closest to `value`, and for
// the double. Throw kNumeric if a literal would not be finite.
std::string literal(double value);
std::string double_literal(double value);

// Returns `inline constexpr float NAME[rows][width] = {...};`, with one row on each line.
std::string table_code(const std::string& name, std::size_t width, const std::vector<std::string>& numbers);

}  // namespace remap
