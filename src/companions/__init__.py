"""What rsphere-compare and rsphere-trade consist of: programs around rsphere, which they run."""
