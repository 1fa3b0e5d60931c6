#include "gallery/stability_data.hpp"

#include <filesystem>

#include "core/text.hpp"
#include "gallery/names.hpp"

namespace lobelia::gallery {
namespace {

WorstError read_error(const Fields& summary, const char* key) {
  const auto error = summary.object(key);
  if (!error) return {};
  return {error->number("ofPeak").value_or(0), error->number("ulp").value_or(0),
          error->number("wrongPixels").value_or(0)};
}

StabilitySummary read_summary(const Fields& fields, const char* name) {
  return {fields.text("group"),
          fields.text(name),
          fields.text("meaning"),
          fields.number("exponent").value_or(0),
          fields.number("cases").value_or(0),
          fields.number("outside").value_or(0),
          fields.number("ofBound").value_or(0),
          read_error(fields, "naive"),
          read_error(fields, "ours")};
}

StabilityCurve read_curve(const Fields& fields) {
  StabilityCurve curve{fields.number("exponent").value_or(0),
                       fields.text("model"),
                       fields.text("lobe"),
                       fields.numbers("degrees"),
                       fields.numbers("truth"),
                       fields.numbers("naive"),
                       fields.numbers("ours")};
  for (const auto* values : {&curve.truth, &curve.naive, &curve.ours})
    if (values->size() != curve.degrees.size())
      fields.fail("degrees", "must be as long as 'truth', 'naive' and 'ours'");
  return curve;
}

/// Pictures lie beside the record, wherever the command was told to put them.
std::string picture_name(const Fields& fields, const char* key) {
  const std::string name = std::filesystem::path(fields.text(key)).filename().string();
  if (!name.empty() && !is_plain_name(name)) fields.fail(key, "must be a plain file name");
  return name;
}

StabilityPicture read_picture(const Fields& fields) {
  StabilityPicture picture;
  picture.exponent = fields.number("exponent").value_or(0);
  if (const auto naive = fields.object("naive")) {
    picture.naive = picture_name(*naive, "png");
    picture.naive_error = picture_name(*naive, "error");
    picture.naive_off = naive->number("largestErrorOfPeak").value_or(0);
  }
  if (const auto ours = fields.object("ours")) {
    picture.ours = picture_name(*ours, "png");
    picture.ours_error = picture_name(*ours, "error");
    picture.ours_off = ours->number("largestErrorOfPeak").value_or(0);
  }
  return picture;
}

}  // namespace

StabilityData read_stability(const Fields& record) {
  StabilityData data{shell_join(record.texts("command")),
                     record.text("instructionSet"),
                     record.number("cases").value_or(0),
                     record.number("outside").value_or(0),
                     record.number("notCompared").value_or(0),
                     {},
                     {},
                     {},
                     {},
                     {}};
  for (const Fields& group : record.objects("groups"))
    data.groups.emplace_back(group.text("name"), group.text("meaning"));
  for (const Fields& one : record.objects("byCase"))
    data.by_case.push_back(read_summary(one, "case"));
  for (const Fields& one : record.objects("byExponent"))
    data.by_exponent.push_back(read_summary(one, "lobe"));
  for (const Fields& one : record.objects("curves")) data.curves.push_back(read_curve(one));
  for (const Fields& one : record.objects("pictures")) data.pictures.push_back(read_picture(one));
  return data;
}

}  // namespace lobelia::gallery
