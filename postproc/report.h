// report.html: one self-contained page to send to a colleague; pictures inside, no links to anything.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/html.h"
#include "postproc/summary.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {

std::string report_html(const std::string& title, const std::vector<ReportPicture>& pictures, const Summary& summary,
                        const Provenance& provenance, const std::string& ended);

/// A number as a reader wants it: prefixed unit, four digits.
std::string readable(double value, const std::string& unit);

}  // namespace lamella
