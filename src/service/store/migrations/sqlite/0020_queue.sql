-- The order in which files of one priority are graded: the time at which a file came, and later for each further file of who
-- sends many at once.
ALTER TABLE submissions ADD COLUMN turn BIGINT NOT NULL DEFAULT 0;
UPDATE submissions SET turn = received_at;
DROP INDEX submissions_waiting;
CREATE INDEX submissions_waiting ON submissions (priority, turn) WHERE state <> 'graded';

-- Who sent a file, until it is graded; see below.
ALTER TABLE submissions ADD COLUMN sender TEXT;

-- The turn of the next file of a browser, a student or an address, and until when their files wait behind all others because one
-- had to be stopped. Senders stand here hashed, and for a minute longer than that.
CREATE TABLE senders (
    sender          TEXT PRIMARY KEY,
    turn            BIGINT NOT NULL,
    suspected_until BIGINT NOT NULL DEFAULT 0
);
