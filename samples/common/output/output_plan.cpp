// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "output_plan.hpp"
#include "atomic_file.hpp"
#include "files.hpp"
#include "options.hpp"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <sys/stat.h>

namespace rsackermann_samples {

namespace {

std::string realPath(const std::string& path)
{
    char resolved[PATH_MAX];
    return realpath(path.empty() ? "." : path.c_str(), resolved) ? resolved : "";
}

std::string parentOf(const std::string& path)
{
    const size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// The real path of a folder, of which only the beginning may exist.
std::string canonicalFolder(const std::string& path)
{
    const std::string real = realPath(path);
    if (!real.empty())
        return real;
    const std::string name = fileName(path), parent = canonicalFolder(parentOf(path));
    if (name.empty() || name == ".")
        return parent;
    if (name == "..")
        return parentOf(parent);
    return parent + (parent == "/" ? "" : "/") + name;
}

std::string existingPartOf(std::string folder)
{
    struct stat status;
    while (folder != "/" && stat(folder.c_str(), &status) != 0)
        folder = parentOf(folder);
    return folder;
}

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

// Whether the file system of a folder takes a and A for the same name.
bool makesNoDifferenceOfCase(const std::string& folder)
{
    try
    {
        const AtomicFile file(existingPartOf(folder) + "/a");
        const std::string& name = file.temporaryName();
        struct stat status;
        std::string other = fileName(name);
        std::transform(other.begin(), other.end(), other.begin(),
                       [](unsigned char c) { return char(std::toupper(c)); });
        return stat((parentOf(name) + "/" + other).c_str(), &status) == 0;
    }
    catch (const InputError&)
    {
        return false; // nothing can be written there in any case
    }
}

// STEM.EXTENSION of STEM_000012.EXTENSION, which may be a frame's; empty if it is no such path.
std::string withoutFrame(const std::string& path)
{
    const size_t underscore = path.find_last_of('_'), dot = path.find('.', underscore);
    if (underscore == std::string::npos || dot == std::string::npos || dot - underscore < 7 ||
        path.find_first_not_of("0123456789", underscore + 1) != dot)
        return "";
    return path.substr(0, underscore) + path.substr(dot);
}

// The common key of all names of an existing file.
std::string identityOf(const std::string& path)
{
    struct stat status;
    if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
        return "";
    return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

} // namespace

OutputPlan::Place OutputPlan::placeOf(const std::string& path)
{
    const Place place = {canonicalFolder(parentOf(path)), fileName(path)};
    folders_.insert(place.folder);
    return place;
}

void OutputPlan::addInput(const std::string& path)
{
    inputs_[canonicalFolder(parentOf(path)) + "/" + fileName(path)] = path;
    const std::string identity = identityOf(path);
    if (!identity.empty())
        inputs_[identity] = path;
}

void OutputPlan::addOutput(const std::string& path, const std::string& source)
{
    const Place place = placeOf(path);
    for (const std::string& key : {place.folder + "/" + place.name, identityOf(path)})
    {
        const std::map<std::string, std::string>::const_iterator input = inputs_.find(key);
        if (input != inputs_.end())
            throw UsageError("the result " + path + " would replace the input " + input->second);
    }
    add(place, path, source);
    if (frames_.count(withoutFrame(place.folder + "/" + place.name)))
        throw UsageError("the result " + path + " would have the name of that of a video's frame");
}

void OutputPlan::addFrames(const std::string& stem, const std::string& extension, const std::string& source)
{
    const Place place = placeOf(stem + extension);
    frames_.insert(place.folder + "/" + place.name);
    for (const std::pair<const std::string, std::string>& input : inputs_)
        if (withoutFrame(input.first) == place.folder + "/" + place.name)
            throw UsageError("the results " + stem + "_*" + extension + " would replace the input " + input.second);
    add({place.folder, place.name + " of frames"}, stem + "_*" + extension, source);
}

void OutputPlan::removeLeftovers() const
{
    for (const std::string& folder : folders_)
        rsackermann_samples::removeLeftovers(folder);
}

void OutputPlan::add(const Place& place, const std::string& path, const std::string& source)
{
    const std::string name = place.folder + "/" + place.name;
    const auto similar = outputs_.equal_range(lowerCase(name));
    for (auto it = similar.first; it != similar.second; ++it)
        if (it->second.name == name || makesNoDifferenceOfCase(place.folder))
            throw UsageError((it->second.source == source ? "two results of " + source
                                                          : "the results of " + it->second.source + " and " + source) +
                             " would have the same name " + path);
    outputs_.insert(std::make_pair(lowerCase(name), Output{name, source}));
}

} // namespace rsackermann_samples
