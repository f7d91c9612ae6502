#include "track/channels.h"

namespace risorius::track {

int ChannelTable::column_count() const {
    int count = 0;
    for (const MuscleChannel& muscle : muscles) count += muscle.paired ? 2 : 1;
    return count;
}

int ChannelTable::column(const std::string& id, Side side) const {
    int column = 0;
    for (const MuscleChannel& muscle : muscles) {
        if (muscle.id == id) return muscle.paired && side == Side::kRight ? column + 1 : column;
        column += muscle.paired ? 2 : 1;
    }
    return -1;
}

std::vector<std::string> ChannelTable::column_names() const {
    std::vector<std::string> names;
    for (const MuscleChannel& muscle : muscles) {
        if (!muscle.paired) {
            names.push_back(muscle.id);
        } else {
            names.push_back(muscle.id + ".l");
            names.push_back(muscle.id + ".r");
        }
    }
    return names;
}

}  // namespace risorius::track
