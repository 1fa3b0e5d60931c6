#include "records/typescript.hpp"

#include "records/pages.hpp"

namespace lobelia::records {

std::string typescript_text() {
  Definitions definitions;
  for (const Struct* page : {&GridPage::type(), &CellPage::type(), &PackedPicture::type(),
                             &StabilityPage::type(), &PaperPage::type(), &ExplorerPage::type()})
    definitions.add(*page);
  std::string text =
      "// What the program gives the pages' scripts. Written by `lobelia records --typescript > "
      "gallery/web/src/records.ts`;\n// do not edit: records/pages.cpp has the tables.\n";
  for (const Struct* one : definitions.all()) text += "\n" + one->interface();
  return text;
}

}  // namespace lobelia::records
