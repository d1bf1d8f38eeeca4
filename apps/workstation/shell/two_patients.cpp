#include "shell/two_patients.h"

namespace ostia::workstation {

bool two_patients(const imaging::ShownIdentity& a, const imaging::ShownIdentity& b) {
  if (!a.patient_id.empty() && !b.patient_id.empty()) return a.patient_id != b.patient_id;
  return !a.patient_name.empty() && !b.patient_name.empty() && a.patient_name != b.patient_name;
}

}  // namespace ostia::workstation
