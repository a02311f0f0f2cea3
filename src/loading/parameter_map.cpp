#include "parameter_map.h"

namespace concave_distance::detail {

ParameterValue readParameter(const YamlValue& value, const ParameterInfo& info) {
  if (!info.word.empty() && value.isText(info.word.c_str())) return info.word;
  const std::string allowed = allowedValues(info);
  ParameterValue read;
  switch (info.type) {
    case ParameterType::Number:
      read = value.number(allowed);
      break;
    case ParameterType::Count:
      if (!value.isScalar()) value.refuse(allowed);
      read = parseParameter(info, value.plainText());
      break;
    case ParameterType::Flag:
      read = value.boolean();
      break;
    case ParameterType::Choice:
    case ParameterType::Text:
    case ParameterType::List:
      if (!value.isScalar()) value.refuse(allowed);
      read = value.plainText();
      break;
  }
  if (!isAllowed(info, read)) value.refuse(allowed);
  return read;
}

}  // namespace concave_distance::detail
