// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "folder.hpp"
#include "values.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace fuzz {

Folder::Folder()
{
    const char* const parent = std::getenv("TMPDIR");
    std::string pattern = std::string(parent ? parent : "/tmp") + "/rsackermann-fuzz-XXXXXX";
    require(mkdtemp(&pattern[0]) != nullptr && chdir(pattern.c_str()) == 0, "there is no temporary folder");
    path_ = pattern;
}

Folder::~Folder()
{
    cv::utils::fs::remove_all(path_);
}

void Folder::write(const std::string& name, const std::string& content) const
{
    std::ofstream file((path_ + "/" + name).c_str(), std::ios::binary);
    require(bool(file << content), "a file can't be written");
}

void Folder::clear() const
{
    std::vector<cv::String> paths;
    cv::utils::fs::glob(path_, "*", paths, false, true);
    for (const cv::String& path : paths)
        cv::utils::fs::remove_all(path);
}

} // namespace fuzz
