// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/result.h"

namespace toile {

std::string_view toString(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument:
      return "InvalidArgument";
    case ErrorCode::FileNotFound:
      return "FileNotFound";
    case ErrorCode::FileUnreadable:
      return "FileUnreadable";
    case ErrorCode::FileUnwritable:
      return "FileUnwritable";
    case ErrorCode::FileFormat:
      return "FileFormat";
    case ErrorCode::UnitsMissing:
      return "UnitsMissing";
    case ErrorCode::NotManifold:
      return "NotManifold";
    case ErrorCode::NotOrientable:
      return "NotOrientable";
    case ErrorCode::DegenerateFace:
      return "DegenerateFace";
    case ErrorCode::ModelMismatch:
      return "ModelMismatch";
    case ErrorCode::NameNotFound:
      return "NameNotFound";
    case ErrorCode::LeavesSilhouette:
      return "LeavesSilhouette";
    case ErrorCode::CurveInvalid:
      return "CurveInvalid";
    case ErrorCode::NotADisk:
      return "NotADisk";
    case ErrorCode::LengthsInfeasible:
      return "LengthsInfeasible";
    case ErrorCode::NotConverged:
      return "NotConverged";
    case ErrorCode::Cancelled:
      return "Cancelled";
    case ErrorCode::Unsupported:
      return "Unsupported";
  }
  return "";
}

std::string_view toString(Element::Kind kind) {
  switch (kind) {
    case Element::Kind::Vertex:
      return "vertex";
    case Element::Kind::Edge:
      return "edge";
    case Element::Kind::Face:
      return "face";
    case Element::Kind::Curve:
      return "curve";
    case Element::Kind::Piece:
      return "piece";
    case Element::Kind::Landmark:
      return "landmark";
    case Element::Kind::Line:
      return "line";
    case Element::Kind::Byte:
      return "byte";
  }
  return "";
}

Error Error::during(std::string_view context) const {
  return {code, std::string(context) + ": " + message, where};
}

}  // namespace toile
