-- A student's personal code is computed from the service's key, the student and this number: the next number is another code.
ALTER TABLE students ADD COLUMN code_generation BIGINT NOT NULL DEFAULT 0;

-- How a browser became a student's: 'code', by the personal code of that generation; 'first', as the first that gave the
-- number, which counts where no roster has the student.
ALTER TABLE owners ADD COLUMN proof TEXT NOT NULL DEFAULT 'first';
ALTER TABLE owners ADD COLUMN code_generation BIGINT NOT NULL DEFAULT 0;
CREATE INDEX owners_of_student ON owners (student_id);
