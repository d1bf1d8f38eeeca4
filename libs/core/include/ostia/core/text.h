#pragma once
/// \file Numbers as text: with a point, whatever the locale. Numbers that are not finite give "inf", "nan"
/// and, where their sign is set, "-inf", "-nan"; a zero with a sign gives "-0", "-0.00". Where a function
/// does otherwise, it says so. Decimals are 0 or more, digits 1 or more.

#include <optional>
#include <string>
#include <string_view>

namespace ostia::core {

/// With `decimals` behind the point, as printf's "%.2f" has it: the nearest to the number's exact value, of
/// two as near the even one. fixed_text(0.125, 2) is "0.12", fixed_text(-0.001, 2) "-0.00".
std::string fixed_text(double value, int decimals);
/// The same with a "+" where there is no "-": "+0.12", "+0.00", "+nan".
std::string signed_text(double value, int decimals);
/// With so many digits and no zeros at the end, as printf's "%.4g" has it: "1235", "0.0001235", "1.235e+04".
std::string significant_text(double value, int digits);
/// The shortest that reads back as the same bits: "0.1", "100", "1e+05". Of two as short the one without
/// exponent.
std::string shortest_text(double value);
/// As fixed_text, without the zeros at the end: "12.5", "12", "-0".
std::string trimmed_text(double value, int most_decimals);
/// With `decimals` behind the point, halves away from zero and zero without a sign: rounded_text(0.125, 2) is
/// "0.13", rounded_text(-0.4, 0) "0". For numbers below 1e15.
std::string rounded_text(double value, int decimals);
/// Six decimals of which `decimals`, 1 to 6, are kept and the rest is cut off: cut_text(1.999, 2) is "1.99".
std::string cut_text(double value, int decimals);
/// With its unit: "1.25 mm".
std::string mm_text(double value, int decimals = 2);

/// As fixed_text; "-" where the number is not finite.
std::string fixed_or_dash(double value, int decimals);
/// For a reader: as fixed_text, zero without a sign, and `unknown` where there is no number or none that is
/// finite.
std::string shown_text(double value, int decimals, std::string_view unknown = "-");
std::string shown_text(const std::optional<double>& value, int decimals, std::string_view unknown = "-");

}  // namespace ostia::core
