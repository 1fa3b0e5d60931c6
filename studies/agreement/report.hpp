// The table of agreement as text, CSV, Markdown and a record.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/agreement/agreement.hpp"
#include "studies/table.hpp"

namespace lobelia::agreement {

using Table =
    studies::Table;  ///< with one remark, which the page prints above it and the text leaves out
/// The worst of each variant by the sharpness of the highlight, with its target.
Table headline_table(const Agreement& agreement);
/// The worst over lights, by variant, lobe and exponent; and by variant, model and exponent.
Table lobe_table(const Agreement& agreement);
Table model_table(const Agreement& agreement);
Table effect_table(const Agreement& agreement);
Table soft_table(const Agreement& agreement);
/// Pictures that cannot be compared, and why.
Table refusal_table(const Agreement& agreement);
/// Every picture that missed its target or failed.
Table miss_table(const Agreement& agreement);

/// "412 pictures compared, all within their targets, 31 not comparable"
std::string verdict_sentence(const Agreement& agreement);

std::string report_text(const Agreement& agreement);
/// docs/agreement.md, as made by `command`.
std::string report_markdown(const Agreement& agreement, std::string_view command);
/// Headings of the page, in their order.
std::vector<std::string> markdown_headings();
records::Agreement report_record(const Agreement& agreement,
                                 const std::vector<std::string>& command);
/// One line a comparison.
std::string report_csv(const Agreement& agreement);

}  // namespace lobelia::agreement
