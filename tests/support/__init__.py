"""Problems with known answers that the tests share."""
