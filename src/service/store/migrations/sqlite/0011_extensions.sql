-- Deadlines of single students, in place of that of the homework.
CREATE TABLE extensions (
    assignment TEXT NOT NULL REFERENCES assignments (id),
    student_id TEXT NOT NULL REFERENCES students (id) ON DELETE CASCADE,
    closes_at  BIGINT NOT NULL,
    reason     TEXT NOT NULL,
    PRIMARY KEY (assignment, student_id)
);
CREATE INDEX extensions_of_student ON extensions (student_id);
