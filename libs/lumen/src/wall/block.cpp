#include "wall/block.h"

#include <algorithm>

namespace ostia::lumen {

const WallPiece* WallBlock::piece_at(CellCode cell) const {
  const int piece = piece_of.empty() ? 0 : piece_of[cell];
  return piece == 0 ? nullptr : &pieces[static_cast<std::size_t>(piece - 1)];
}
WallPiece* WallBlock::piece_at(CellCode cell) {
  return const_cast<WallPiece*>(std::as_const(*this).piece_at(cell));
}

void WallBlock::number_pieces() {
  piece_of.assign(pieces.empty() ? 0 : cell_codes, 0);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const CellCode cell : pieces[i].cells) piece_of[cell] = static_cast<std::int16_t>(i + 1);
}

void forget_pieces(WallBlock& block) {
  for (const WallPiece& piece : block.pieces)
    block.likely.insert(block.likely.end(), piece.cells.begin(), piece.cells.end());
  block.pieces.clear();
  block.piece_of.clear();
}

void settle(WallBlock& block) {
  const std::size_t dropped =
      std::erase_if(block.pieces, [](const WallPiece& piece) { return !piece.reached; });
  const auto by_cell = [](const WallPiece& a, const WallPiece& b) {
    return a.cells.front() < b.cells.front();
  };
  if (dropped > 0 || !std::is_sorted(block.pieces.begin(), block.pieces.end(), by_cell)) {
    std::sort(block.pieces.begin(), block.pieces.end(), by_cell);
    block.number_pieces();
  }
  block.kept.nodes.insert(block.kept.nodes.end(), block.fresh.nodes.begin(), block.fresh.nodes.end());
  block.kept.crossings.insert(block.kept.crossings.end(), block.fresh.crossings.begin(),
                              block.fresh.crossings.end());
  block.fresh = {};
  block.likely.clear();
}

}  // namespace ostia::lumen
