#include "records/highlight.hpp"

#include <sys/utsname.h>

#include <thread>

#include "core/host.hpp"

namespace lobelia::records {

const Struct& Host::type() {
  return define<Host>("Host", "The machine.", [](Struct& t) {
    t.key<&Host::processor>("processor");
    t.key<&Host::threads>("threads");
    t.key<&Host::system>("system");
    t.key<&Host::name>("name").if_any();
  });
}

Host this_host() {
  utsname system{};
  ::uname(&system);
  return {processor_name(), std::thread::hardware_concurrency(),
          std::string(system.sysname) + " " + system.release + " " + system.machine, ""};
}

Host this_node() {
  Host host = this_host();
  host.name = host_name();
  return host;
}

const Struct& Highlight::type() {
  return define<Highlight>("Highlight", "A normalised highlight.", [](Struct& t) {
    t.key<&Highlight::model>("model");
    t.key<&Highlight::lobe>("lobe");
    t.key<&Highlight::normalisation>("normalisation");
    t.key<&Highlight::exponent>("exponent").at_least(0);
    t.key<&Highlight::coefficient>("coefficient", "of the radiance").may_be_nonfinite();
    t.key<&Highlight::warning>("warning", "where the model is not what it promises").if_any();
  });
}

}  // namespace lobelia::records
