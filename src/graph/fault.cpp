// Faults as text.
#include <fmt/format.h>

#include "graph/validate.hpp"

namespace lucerna::graph {

const char* nameOf(FaultKind kind) {
  switch (kind) {
    case FaultKind::UnknownPass:
      return "UnknownPass";
    case FaultKind::UnknownPort:
      return "UnknownPort";
    case FaultKind::UnknownParameter:
      return "UnknownParameter";
    case FaultKind::MissingInput:
      return "MissingInput";
    case FaultKind::TypeMismatch:
      return "TypeMismatch";
    case FaultKind::FormatMismatch:
      return "FormatMismatch";
    case FaultKind::SizeMismatch:
      return "SizeMismatch";
    case FaultKind::ReadBeforeWrite:
      return "ReadBeforeWrite";
    case FaultKind::ReadAfterUpdate:
      return "ReadAfterUpdate";
    case FaultKind::Cycle:
      return "Cycle";
    case FaultKind::DuplicateName:
      return "DuplicateName";
    case FaultKind::ValueOutOfRange:
      return "ValueOutOfRange";
    case FaultKind::WrongValueType:
      return "WrongValueType";
    case FaultKind::UnusableValue:
      return "UnusableValue";
    case FaultKind::OutputNeverRead:
      return "OutputNeverRead";
    case FaultKind::DisabledWithoutStandIn:
      return "DisabledWithoutStandIn";
    case FaultKind::ProducerChanged:
      return "ProducerChanged";
    case FaultKind::MadeLater:
      return "MadeLater";
    case FaultKind::MissingFeature:
      return "MissingFeature";
    case FaultKind::UnsupportedFormat:
      return "UnsupportedFormat";
    case FaultKind::BadOutput:
      return "BadOutput";
    case FaultKind::EmptyPipeline:
      return "EmptyPipeline";
    case FaultKind::WrongFrequency:
      return "WrongFrequency";
    case FaultKind::BadForm:
      return "BadForm";
  }
  return "";
}

std::string Fault::text() const {
  std::string text = fmt::format("{} [{}]\n  found:  {}", place, nameOf(kind), found);
  if (!wanted.empty()) text += fmt::format("\n  wanted: {}", wanted);
  if (!remedy.empty()) text += fmt::format("\n  to do:  {}", remedy);
  return text;
}

std::string Validation::text() const {
  std::string text;
  for (const Fault& fault : faults)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n",
                        fault.severity == Severity::Error ? "error" : "warning", fault.text());
  return text;
}

}  // namespace lucerna::graph
